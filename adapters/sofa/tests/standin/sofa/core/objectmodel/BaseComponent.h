// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/config.h>
#include <sofa/helper/Messages.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace sofa::core::objectmodel {

/// A setting of a component, whatever its type.
class BaseData {
 public:
  BaseData() = default;
  BaseData(const BaseData&) = delete;
  BaseData& operator=(const BaseData&) = delete;
  BaseData(BaseData&&) = delete;
  BaseData& operator=(BaseData&&) = delete;
  virtual ~BaseData() = default;
  virtual bool copyValueFrom(const BaseData* other) = 0;
};

template <class T>
struct DataDefault {
  T value;
};

template <class T>
class Data : public BaseData {
 public:
  explicit Data(DataDefault<T> initial) : m_value(std::move(initial.value)) {}

  [[nodiscard]] const T& getValue() const { return m_value; }
  [[nodiscard]] bool isSet() const { return m_isSet; }
  void setValue(const T& value) {
    m_value = value;
    m_isSet = true;
  }
  bool copyValueFrom(const BaseData* other) override {
    setValue(static_cast<const Data<T>*>(other)->getValue());
    return true;
  }

 private:
  T m_value;
  bool m_isSet = false;
};

/// A place in the scene; the components of one node share one.
class BaseContext {};

class Base {
 public:
  Base() = default;
  Base(const Base&) = delete;
  Base& operator=(const Base&) = delete;
  Base(Base&&) = delete;
  Base& operator=(Base&&) = delete;
  virtual ~Base() = default;

  template <class T>
  DataDefault<T> initData(Data<T>* data, const T& value, const char* name, const char* /*help*/) {
    m_data[name] = data;
    return {value};
  }
  template <class T>
  DataDefault<T> initData(Data<T>* data, const char* name, const char* /*help*/) {
    m_data[name] = data;
    return {T{}};
  }

  [[nodiscard]] BaseData* findData(const std::string& name) const { return m_data.at(name); }
  [[nodiscard]] std::string getPathName() const { return "/" + m_name; }
  void setName(const std::string& name) { m_name = name; }

 private:
  std::map<std::string, BaseData*> m_data;
  std::string m_name;
};

class BaseComponent : public virtual Base {
 public:
  virtual void init() {}
  virtual void reinit() {}

  [[nodiscard]] const BaseContext* getContext() const { return m_context; }
  void setContext(const BaseContext* context) { m_context = context; }

 private:
  const BaseContext* m_context = nullptr;
};

/// Makes a component; their constructors are protected.
template <class T>
std::shared_ptr<T> New() {
  return std::shared_ptr<T>(new T);
}

}  // namespace sofa::core::objectmodel

#define SOFA_CLASS(T, Parent)      \
  using SPtr = std::shared_ptr<T>; \
  using Inherit1 = Parent;         \
  template <class U>               \
  friend std::shared_ptr<U> sofa::core::objectmodel::New()
