// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <utility>

#include "Bindings.h"
#include "Bounds.h"
#include "BufferProtocol.h"
#include "Interrupts.h"
#include "LoadedScene.h"
#include "PairArray.h"
#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

std::shared_ptr<LoadedScene> load(const std::filesystem::path& path, scene::ReadOptions& options) {
  return stoppably(kLong, Runs::Alone, [&](const StopFlag& stop) {
    options.stop = &stop;
    return std::make_shared<LoadedScene>(path, options);
  });
}

std::unique_ptr<PairArray> detect(LoadedScene& scene, const DetectionOptions& options) {
  const Runs runs = options.threads == 1 ? Runs::Alone : Runs::OnThreads;
  return interruptibly(scene.size(), runs, [&](Stopper& stopper) { return toPython(scene.detect(options, stopper)); });
}

/// The fields of the package's Model, in its order.
py::tuple modelOf(const LoadedScene& scene, std::size_t index) {
  const scene::ModelRecord record = scene.model(index);
  return py::make_tuple(textOf(record.name), textOf(record.type), record.elements, record.active, record.simulated,
                        record.moving, record.selfCollision, py::tuple(py::cast(record.groups)),
                        record.contactDistance);
}

/// The fields of the package's Remark, in its order.
py::list remarkList(std::span<const scene::Remark> from) {
  py::list remarks;
  for (const scene::Remark& remark : from) {
    remarks.append(py::make_tuple(pathOf(remark.file), remark.line, textOf(remark.subject),
                                  textOf(withArguments(remark.reason)), remark.isPartial));
  }
  return remarks;
}

std::optional<Bounds> regionOf(const LoadedScene& scene) {
  const std::optional<Box> box = scene.region();
  if (!box) return std::nullopt;
  return Bounds{box->min[0], box->min[1], box->min[2], box->max[0], box->max[1], box->max[2]};
}

scene::SofaVersion sofaVersion(const std::string& version) {
  try {
    return scene::sofaVersionOf(version);
  } catch (const InvalidArgument& problem) {
    throw InvalidArgument(std::string("sofa: ") + problem.what());
  }
}

void bindReadOptions(py::module_& module) {
  module.def("sofa_version", &sofaVersion);
  py::enum_<scene::SofaVersion>(module, "SofaVersion")
      .value("from_scene", scene::SofaVersion::FromScene)
      .value("sofa_2006", scene::SofaVersion::Sofa2006)
      .value("sofa_2612", scene::SofaVersion::Sofa2612);
  py::class_<scene::ReadOptions>(module, "ReadOptions")
      .def(py::init<>())
      .def_readwrite("search_roots", &scene::ReadOptions::searchRoots)
      .def_readwrite("partial", &scene::ReadOptions::partial)
      .def_readwrite("sofa", &scene::ReadOptions::sofa)
      .def_readwrite("allow_outside", &scene::ReadOptions::allowOutside)
      .def_readwrite("max_memory", &scene::ReadOptions::maxMemory)
      .def_readwrite("recursive", &scene::ReadOptions::recursive);
}

}  // namespace

void bindScene(py::module_& module) {
  bindReadOptions(module);
  py::class_<DetectionOptions>(module, "DetectionOptions")
      .def(py::init<>())
      .def_readwrite("distance", &DetectionOptions::distance)
      .def_readwrite("strategy", &DetectionOptions::strategy)
      .def_readwrite("threads", &DetectionOptions::threads)
      .def_readwrite("verify", &DetectionOptions::verify)
      .def("set_region", [](DetectionOptions& self, const Bounds& region) { self.region = boxOf(region); });
  py::class_<LoadedScene, std::shared_ptr<LoadedScene>>(module, "Scene", tableProtocol<LoadedScene>())
      .def("__len__", &LoadedScene::size)
      .def("model", &modelOf)
      .def("remarks", [](const LoadedScene& scene) { return remarkList(scene.remarks()); })
      .def("warnings", [](const LoadedScene& scene) { return remarkList(scene.warnings()); })
      .def("method", [](const LoadedScene& scene) { return textOf(scene.method()); })
      .def("alarm_distance", &LoadedScene::alarmDistance)
      .def("region", &regionOf)
      .def("detect", &detect);
  module.def("load", &load);
}

}  // namespace allpairs::python
