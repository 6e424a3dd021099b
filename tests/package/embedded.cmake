# Uses the source tree by FetchContent from another project, without installing it: the engine and the component.

include(${CMAKE_CURRENT_LIST_DIR}/Steps.cmake)
file(REMOVE_RECURSE ${WORK})
configure_consumer(
  ${WORK}/build -D ALLPAIRS_SOURCE=${ALLPAIRS_SOURCE} -D PARTS=engine,collision -D BUILD_SHARED_LIBS=${SHARED})
build_and_run(${WORK}/build)
