// SPDX-License-Identifier: MIT
#include "allpairs/scene/EmptyBoxes.h"

#include "allpairs/scene/Scene.h"

namespace allpairs::scene {
namespace {

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

}  // namespace

std::string emptyReason(const EmptyBoxes& boxes) {
  std::string reason = std::string("min above max on ") + "xyz"[boxes.axis];
  if (const std::uint64_t others = boxes.count - 1; boxes.count > 1)
    reason += " (and " + grouped(others) + (others == 1 ? " other box)" : " other boxes)");
  return reason + ": empty, in no pair";
}

Remark emptyRemark(const EmptyBoxes& boxes, const std::filesystem::path& file, const std::string& name) {
  const std::string number = std::to_string(boxes.first);
  const std::string subject = "box " + number + (name == number ? "" : " '" + name + "'");
  return {.file = file, .subject = subject, .reason = emptyReason(boxes)};
}

}  // namespace allpairs::scene
