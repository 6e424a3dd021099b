// SPDX-License-Identifier: MIT
#include "SceneRun.h"

#include <sofa/core/CollisionModel.h>
#include <sofa/core/ObjectFactory.h>
#include <sofa/core/objectmodel/BaseObjectDescription.h>
#include <sofa/helper/system/FileRepository.h>
#include <sofa/helper/system/PluginManager.h>
#include <sofa/simulation/Simulation.h>
#include <sofa/simulation/common/init.h>
#include <sofa/simulation/graph/DAGSimulation.h>
#include <sofa/simulation/graph/init.h>

#include <algorithm>
#include <stdexcept>

namespace allpairs::tools {
namespace {

using sofa::core::objectmodel::BaseComponent;

bool isLoaded(sofa::helper::system::PluginManager::PluginLoadStatus status) {
  using Status = sofa::helper::system::PluginManager::PluginLoadStatus;
  return status == Status::SUCCESS || status == Status::ALREADY_LOADED;
}

BroadPhase::SPtr makeBroadPhase(sofa::core::objectmodel::BaseContext& context, const std::string& name,
                                const std::string& className) {
  sofa::core::objectmodel::BaseObjectDescription description(name.c_str(), className.c_str());
  const BaseComponent::SPtr made = sofa::core::ObjectFactory::CreateObject(&context, &description);
  auto* phase = dynamic_cast<BroadPhase*>(made.get());
  if (phase == nullptr) throw std::runtime_error("SOFA can't make a broad phase of the class " + className);
  return phase;
}

}  // namespace

void loadPlugins(const std::vector<std::string>& names) {
  sofa::simulation::common::init();
  sofa::simulation::graph::init();
  auto& plugins = sofa::helper::system::PluginManager::getInstance();
  for (const std::string& plugin : names) {
    if (!isLoaded(plugins.loadPlugin(plugin))) throw std::runtime_error("SOFA can't load the plugin " + plugin);
    sofa::core::ObjectFactory::getInstance()->registerObjectsFromPlugin(plugin);
  }
}

SceneRun::SceneRun(const Settings& settings, const std::string& broadPhaseClass) {
  for (const std::string& folder : settings.dataFolders) {
    sofa::helper::system::DataRepository.addFirstPath(folder);
  }
  loadPlugins(settings.plugins);
  m_root = sofa::simulation::node::load(settings.scene);
  if (!m_root) throw std::runtime_error("SOFA can't load " + settings.scene);
  if (!broadPhaseClass.empty()) {
    for (BroadPhase* phase : broadPhases()) replace(*phase, broadPhaseClass);
  }
  sofa::simulation::node::initRoot(m_root.get());
}

SceneRun::~SceneRun() {
  if (m_root) sofa::simulation::node::unload(m_root);
}

void SceneRun::replace(BroadPhase& old, const std::string& broadPhaseClass) {
  const BroadPhase::SPtr keptAlive = &old;
  auto* context = old.getContext();
  context->removeObject(keptAlive);
  const BroadPhase::SPtr made = makeBroadPhase(*context, old.getName(), broadPhaseClass);
  auto* from = old.findData("box");
  auto* to = made->findData("box");
  if (from != nullptr && to != nullptr && from->isSet()) to->copyValueFrom(from);
  for (BaseComponent* component : m_root->getTreeObjects<BaseComponent>()) {
    auto* link = component->findLink("broadPhaseDetection");
    if (link != nullptr && link->getSize() > 0 && link->getLinkedBase() == &old) {
      link->read(std::string("@").append(made->getPathName()));
    }
  }
}

void SceneRun::step() { sofa::simulation::node::animate(m_root.get()); }

BroadPhase& SceneRun::make(const std::string& broadPhaseClass) {
  BroadPhase& phase = *makeBroadPhase(*m_root, "measured" + broadPhaseClass, broadPhaseClass);
  phase.init();
  return phase;
}

std::vector<BroadPhase*> SceneRun::broadPhases() const { return m_root->getTreeObjects<BroadPhase>(); }

std::vector<sofa::core::behavior::BaseMechanicalState*> SceneRun::states() const {
  return m_root->getTreeObjects<sofa::core::behavior::BaseMechanicalState>();
}

std::vector<sofa::core::collision::Pipeline*> SceneRun::pipelines() const {
  return m_root->getTreeObjects<sofa::core::collision::Pipeline>();
}

std::vector<sofa::core::CollisionModel*> SceneRun::models() const {
  auto levels = m_root->getTreeObjects<sofa::core::CollisionModel>();
  levels.erase(std::remove_if(levels.begin(), levels.end(), [](auto* level) { return level->getNext() != nullptr; }),
               levels.end());
  return levels;
}

std::size_t SceneRun::countModels() const { return models().size(); }

}  // namespace allpairs::tools
