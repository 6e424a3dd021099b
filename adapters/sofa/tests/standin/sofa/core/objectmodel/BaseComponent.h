// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/config.h>
#include <sofa/core/objectmodel/DDGNode.h>
#include <sofa/helper/Messages.h>

#include <map>
#include <sstream>
#include <string>
#include <utility>

namespace sofa::core::objectmodel {

/// A setting of a component, whatever its type.
class BaseData : public DDGNode {
 public:
  virtual bool copyValueFrom(const BaseData* other) = 0;
  virtual bool read(const std::string& text) = 0;

  /// Takes its value from another of the same type from now on.
  void setParent(BaseData* parent) {
    m_parent = parent;
    addInput(parent);
  }
  void update() override {
    if (m_parent != nullptr) copyValueFrom(m_parent);
    cleanDirty();
  }

 private:
  BaseData* m_parent = nullptr;
};

template <class T>
struct DataDefault {
  T value;
};

template <class T>
class Data : public BaseData {
 public:
  explicit Data(DataDefault<T> initial) : m_value(std::move(initial.value)) {}

  [[nodiscard]] const T& getValue() const {
    if (isDirty()) const_cast<Data*>(this)->update();  // as in SOFA
    return m_value;
  }
  [[nodiscard]] bool isSet() const { return m_isSet; }
  T* beginEdit() {
    m_isSet = true;
    setDirtyOutputs();
    return &m_value;
  }
  void endEdit() { notifyEndEdit(); }
  void setValue(const T& value) {
    *beginEdit() = value;
    endEdit();
  }
  bool copyValueFrom(const BaseData* other) override {
    setValue(static_cast<const Data<T>*>(other)->getValue());
    return true;
  }
  bool read(const std::string& text) override {
    std::istringstream stream(text);
    if constexpr (requires { stream >> m_value; }) {
      stream >> *beginEdit();
      endEdit();
    }
    return !stream.fail();
  }

 private:
  T m_value;
  bool m_isSet = false;
};

/// Holds one of those who keep a component alive.
template <class T>
class SharedPointer {
 public:
  SharedPointer() = default;
  SharedPointer(T* object) : m_object(object) {  // NOLINT(google-explicit-constructor): SOFA's is not
    if (m_object != nullptr) m_object->hold();
  }
  SharedPointer(const SharedPointer& other) : SharedPointer(other.m_object) {}
  SharedPointer(SharedPointer&& other) noexcept : m_object(std::exchange(other.m_object, nullptr)) {}
  template <class U>
  SharedPointer(const SharedPointer<U>& other) : SharedPointer(other.get()) {}  // NOLINT(google-explicit-constructor)
  SharedPointer& operator=(SharedPointer other) noexcept {
    std::swap(m_object, other.m_object);
    return *this;
  }
  ~SharedPointer() {
    if (m_object != nullptr) m_object->release();
  }

  [[nodiscard]] T* get() const { return m_object; }
  T* operator->() const { return m_object; }
  T& operator*() const { return *m_object; }
  explicit operator bool() const { return m_object != nullptr; }
  void reset() { *this = SharedPointer(); }

 private:
  T* m_object = nullptr;
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

  [[nodiscard]] BaseData* findData(const std::string& name) const {
    const auto found = m_data.find(name);
    return found == m_data.end() ? nullptr : found->second;
  }
  virtual bool parseField(const std::string& attribute, const std::string& value) {
    BaseData* data = findData(attribute);
    return data != nullptr && data->read(value);
  }
  [[nodiscard]] std::string getPathName() const { return "/" + m_name; }
  void setName(const std::string& name) { m_name = name; }

  [[nodiscard]] int holders() const { return m_holders; }
  void hold() { ++m_holders; }
  void release() {
    if (--m_holders == 0) delete this;
  }

 private:
  std::map<std::string, BaseData*> m_data;
  std::string m_name;
  int m_holders = 0;
};

class BaseComponent : public virtual Base {
 public:
  virtual void init() {}
  virtual void reinit() {}
  virtual void cleanup() {}

  [[nodiscard]] const BaseContext* getContext() const { return m_context; }
  void setContext(const BaseContext* context) { m_context = context; }

 private:
  const BaseContext* m_context = nullptr;
};

/// Makes a component; their constructors are protected.
template <class T>
SharedPointer<T> New() {
  return SharedPointer<T>(new T);
}

}  // namespace sofa::core::objectmodel

#define SOFA_CLASS(T, Parent)                             \
  using SPtr = sofa::core::objectmodel::SharedPointer<T>; \
  using Inherit1 = Parent;                                \
  template <class U>                                      \
  friend sofa::core::objectmodel::SharedPointer<U> sofa::core::objectmodel::New()
