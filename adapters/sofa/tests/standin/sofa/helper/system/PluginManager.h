// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace sofa::helper::system {

/// Remembers which plugins said that they are there.
class PluginManager {
 public:
  static PluginManager& getInstance() {
    static PluginManager manager;
    return manager;
  }
  void registerPlugin(const std::string& name) { plugins.push_back(name); }

  std::vector<std::string> plugins;
};

}  // namespace sofa::helper::system
