// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ViewScene.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// Names, words and settings of a scene as JSON in which no character can end a script element; and, in the same order
/// as its list of arrays says, the numbers as bytes.
class SceneData {
 public:
  explicit SceneData(const ViewScene& scene);

  [[nodiscard]] const std::string& json() const { return m_json; }

  /// Writes the arrays as base64.
  void writeBase64(scene::ByteSink sink) const;

 private:
  std::string m_json;
  std::string m_bytes;
};

}  // namespace allpairs::view
