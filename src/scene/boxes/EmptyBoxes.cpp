// SPDX-License-Identifier: MIT
#include "allpairs/scene/EmptyBoxes.h"

#include "allpairs/Error.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

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
