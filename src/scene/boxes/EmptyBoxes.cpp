// SPDX-License-Identifier: MIT
#include "allpairs/scene/EmptyBoxes.h"

#include "allpairs/Error.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/Scene.h"
#include "input/FileBytes.h"

namespace allpairs::scene {

std::string emptyReason(const EmptyBoxes& boxes) {
  std::string reason = std::string("min above max on ") + "xyz"[boxes.axis];
  if (const std::uint64_t others = boxes.count - 1; boxes.count > 1)
    reason += " (and " + grouped(others) + (others == 1 ? " other box)" : " other boxes)");
  return reason + ": empty, in no pair";
}

std::vector<Remark> boxWarnings(const BoxArray& boxes, const std::filesystem::path& file) {
  std::vector<Remark> warnings;
  if (boxes.size() == 0 && lowerExtension(file) == ".csv")
    warnings.push_back({.file = file, .reason = "holds no boxes"});
  EmptyBoxes empty;
  empty.look(boxes.boxes(), 0);
  if (empty.count > 0) {
    const std::string number = std::to_string(empty.first);
    const std::string name = boxes.name(static_cast<std::size_t>(empty.first));
    const std::string subject = "box " + number + (name == number ? "" : " '" + name + "'");
    warnings.push_back({.file = file, .subject = subject, .reason = emptyReason(empty)});
  }
  for (const LineNote& note : boxes.notes())
    warnings.push_back({.file = file, .line = note.line, .reason = note.reason});
  return warnings;
}

}  // namespace allpairs::scene
