// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/objectmodel/BaseComponent.h>

#include <functional>
#include <string>
#include <vector>

namespace sofa::core {

class ObjectRegistrationData {
 public:
  explicit ObjectRegistrationData(std::string text) : description(std::move(text)) {}

  template <class T>
  ObjectRegistrationData& add() {
    makers.emplace_back([] { return objectmodel::New<T>(); });
    return *this;
  }

  std::string description;
  std::vector<std::function<objectmodel::SharedPointer<objectmodel::BaseComponent>()>> makers;
};

/// Knows how to make components.
class ObjectFactory {
 public:
  void registerObjects(const ObjectRegistrationData& data) { registered.push_back(data); }

  std::vector<ObjectRegistrationData> registered;
};

}  // namespace sofa::core
