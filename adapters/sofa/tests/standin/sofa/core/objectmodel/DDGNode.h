// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <vector>

namespace sofa::core::objectmodel {

/// A value that others depend on: when it changes they are told once, until they have looked.
class DDGNode {
 public:
  DDGNode() = default;
  DDGNode(const DDGNode&) = delete;
  DDGNode& operator=(const DDGNode&) = delete;
  DDGNode(DDGNode&&) = delete;
  DDGNode& operator=(DDGNode&&) = delete;
  virtual ~DDGNode() {
    for (DDGNode* input : m_inputs) forget(input->m_outputs, this);
    for (DDGNode* output : m_outputs) forget(output->m_inputs, this);
  }

  void addInput(DDGNode* input) {
    assert(std::find(m_inputs.begin(), m_inputs.end(), input) == m_inputs.end() && "as SOFA asks");
    m_inputs.push_back(input);
    input->m_outputs.push_back(this);
    setDirtyValue();
  }
  void delInput(DDGNode* input) {
    forget(m_inputs, input);
    forget(input->m_outputs, this);
  }
  const std::vector<DDGNode*>& getInputs() { return m_inputs; }

  virtual void update() = 0;
  virtual void notifyEndEdit() {
    for (DDGNode* output : m_outputs) output->notifyEndEdit();
  }

  [[nodiscard]] bool isDirty() const { return m_dirtyValue; }
  virtual void setDirtyValue() {
    if (m_dirtyValue) return;
    m_dirtyValue = true;
    setDirtyOutputs();
  }
  virtual void setDirtyOutputs() {
    if (m_dirtyOutputs) return;
    m_dirtyOutputs = true;
    for (DDGNode* output : m_outputs) output->setDirtyValue();
  }
  void cleanDirty() {
    if (!m_dirtyValue) return;
    m_dirtyValue = false;
    for (DDGNode* input : m_inputs) input->m_dirtyOutputs = false;
  }

 private:
  static void forget(std::vector<DDGNode*>& nodes, DDGNode* node) {
    nodes.erase(std::remove(nodes.begin(), nodes.end(), node), nodes.end());
  }

  std::vector<DDGNode*> m_inputs;
  std::vector<DDGNode*> m_outputs;
  bool m_dirtyValue = false;
  bool m_dirtyOutputs = false;
};

}  // namespace sofa::core::objectmodel
