// SPDX-License-Identifier: MIT
#include <array>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"

namespace allpairs::scene::sofa {
namespace {

/// What a driver says of its device before that has moved.
struct DeviceData {
  std::string_view driver;
  std::string_view name;
  std::vector<double> start;
};

const DeviceData* dataOf(const Component& driver, std::string_view name) {
  static const std::array<DeviceData, 8> kData{{{"RazerHydraDriver", "positionBase", {0, 0, 0}},
                                                {"RazerHydraDriver", "orientationBase", {0, 0, 0, 1}},
                                                {"RazerHydraDriver", "positionFirstTool", {0, 0, 0}},
                                                {"RazerHydraDriver", "positionSecondTool", {0, 0, 0}},
                                                {"RazerHydraDriver", "orientationFirstTool", {0, 0, 0, 1}},
                                                {"RazerHydraDriver", "orientationSecondTool", {0, 0, 0, 1}},
                                                {"GeomagicDriver", "positionBase", {0, 0, 0}},
                                                {"GeomagicDriver", "orientationBase", {0, 0, 0, 1}}}};
  for (const auto& data : kData)
    if (data.driver == driver.type && data.name == name) return &data;
  return nullptr;
}

}  // namespace

std::optional<Numbers> deviceOutput(Evaluation& evaluation, const Component& driver, std::string_view name) {
  const auto* data = dataOf(driver, name);
  if (data == nullptr) return std::nullopt;
  const auto given = evaluation.numbers(driver, {name}, data->start.size());
  if (!name.ends_with("Base"))
    evaluation.warn(driver, "a device moves its " + std::string{name} + "; here all is where the device starts");
  return given && given->size() == 1 ? *given : Numbers{data->start, data->start.size()};
}

}  // namespace allpairs::scene::sofa
