#!/bin/bash -eu
# For OSS-Fuzz, which sets CXX, CXXFLAGS, LIB_FUZZING_ENGINE, SRC, WORK and OUT. Written after its documentation; not run
# there yet. Libraries of the system are copied beside the targets, since the machines that run them have none but those
# of C. They find each other there by an rpath, which holds for libraries of libraries too, as a runpath does not.
cd "$SRC/allpairs"
export LDFLAGS="${LDFLAGS:-} -Wl,--disable-new-dtags"
cmake -S . -B "$WORK/build" -G Ninja \
  -D CMAKE_BUILD_TYPE=RelWithDebInfo \
  -D ALLPAIRS_BUILD_FUZZERS=ON \
  -D ALLPAIRS_FUZZING_ENGINE="$LIB_FUZZING_ENGINE" \
  -D ALLPAIRS_BUILD_APP=OFF \
  -D ALLPAIRS_BUILD_TESTS=OFF \
  -D ALLPAIRS_BUILD_EXAMPLES=OFF \
  -D ALLPAIRS_INSTALL=OFF \
  -D ALLPAIRS_FCL=OFF \
  -D ALLPAIRS_BULLET=OFF \
  -D ALLPAIRS_COAL=OFF \
  -D ALLPAIRS_SOFA=OFF \
  -D CMAKE_BUILD_WITH_INSTALL_RPATH=ON \
  -D CMAKE_INSTALL_RPATH="\$ORIGIN/lib"
cmake --build "$WORK/build"

mkdir -p "$OUT/lib"
for program in "$WORK"/build/fuzzers/fuzz_*; do
  target=${program##*/fuzz_}
  cp "$program" "$OUT/"
  ldd "$program" | awk '$3 ~ "^/" { print $3 }' |
    { grep --extended-regexp --invert-match '/(ld-linux[^/]*|lib(c|m|dl|rt|pthread))\.so[^/]*$' || true; } | xargs --no-run-if-empty cp --no-clobber --target-directory="$OUT/lib"
  zip --junk-paths --quiet --recurse-paths "$OUT/fuzz_${target}_seed_corpus.zip" "fuzz/corpus/$target"
  dictionary=fuzz/dictionaries/$target.dict
  [[ ! -f $dictionary ]] || cp "$dictionary" "$OUT/fuzz_$target.dict"
done
