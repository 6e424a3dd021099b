// SPDX-License-Identifier: MIT
#include "allpairs/World.h"

#include "Bindings.h"
#include "BufferProtocol.h"
#include "MovingBoxes.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

template <std::uint32_t BoxProperties::*Field>
void setField(Properties& properties, const py::buffer& values) {
  properties.setField(Field, values);
}

void bindProperties(py::module_& module) {
  py::class_<Properties>(module, "Properties")
      .def(py::init<std::size_t>())
      .def("set_category", &setField<&BoxProperties::category>)
      .def("set_mask", &setField<&BoxProperties::mask>)
      .def("set_group", &setField<&BoxProperties::group>)
      .def("set_world", &setField<&BoxProperties::world>)
      .def("set_margin", &Properties::setMargins)
      .def("set_static", &Properties::setStatic);
  py::class_<QueryFilter>(module, "QueryFilter")
      .def(py::init<>())
      .def_readwrite("category", &QueryFilter::category)
      .def_readwrite("mask", &QueryFilter::mask)
      .def_readwrite("static", &QueryFilter::staticBoxes)
      .def_readwrite("moving", &QueryFilter::dynamicBoxes)
      .def_readwrite("world", &QueryFilter::world);
}

}  // namespace

void bindWorld(py::module_& module) {
  const py::class_<IdArray> ids(module, "IdArray", tableProtocol<IdArray>());
  const py::class_<RealArray> reals(module, "RealArray", tableProtocol<RealArray>());
  bindProperties(module);
  module.attr("NO_BOX") = kNoBox;
  module.attr("EVERY_WORLD") = kEveryWorld;
  py::class_<WorldStatistics>(module, "WorldStatistics")
      .def_readonly("box_tests", &WorldStatistics::boxTests)
      .def_readonly("group_tests", &WorldStatistics::groupTests)
      .def_readonly("exact_tests", &WorldStatistics::exactTests)
      .def_readonly("changed", &WorldStatistics::changed)
      .def_readonly("joined_all", &WorldStatistics::joinedAll)
      .def_readonly("rebuilds", &WorldStatistics::rebuilds);
  py::class_<MovingBoxes>(module, "World")
      .def(py::init<double, Order, std::size_t>())
      .def("add", &MovingBoxes::add)
      .def("move", &MovingBoxes::move)
      .def("move_swept", &MovingBoxes::moveSwept)
      .def("remove", &MovingBoxes::remove)
      .def("clear", &MovingBoxes::clear)
      .def("set_properties", &MovingBoxes::setProperties)
      .def("reserve", &MovingBoxes::reserve)
      .def("shrink", &MovingBoxes::shrink)
      .def("size", &MovingBoxes::size)
      .def("contains", &MovingBoxes::contains)
      .def("ids", &MovingBoxes::ids)
      .def("boxes", &MovingBoxes::boxes)
      .def("properties", &MovingBoxes::properties)
      .def("state", &MovingBoxes::state)
      .def("step", &MovingBoxes::step)
      .def("result_of", &MovingBoxes::resultOf)
      .def("statistics", &MovingBoxes::statistics)
      .def("overlapping", &MovingBoxes::overlapping)
      .def("first_hits", &MovingBoxes::firstHits)
      .def("all_hits", &MovingBoxes::allHits)
      .def("nearest", &MovingBoxes::nearest)
      .def("between", &MovingBoxes::between);
}

}  // namespace allpairs::python
