// SPDX-License-Identifier: MIT
#include "allpairs/scene/WriteResult.h"

namespace allpairs::scene {

ModelRecord modelRecord(const collision::CollisionModel& model) {
  const collision::CollisionModel& elements = *model.getLast();
  const bool hasRoot = !elements.empty() && elements.hasBoundingTree();
  return {.name = elements.getName(),
          .type = std::string(elements.typeName()),
          .elements = elements.getSize(),
          .box = hasRoot ? elements.getFirst()->elementBox(0) : kEmptyBox,
          .active = elements.isActive(),
          .simulated = elements.isSimulated(),
          .moving = elements.isMoving(),
          .selfCollision = elements.getSelfCollision(),
          .groups = elements.getGroups(),
          .contactDistance = elements.getContactDistance()};
}

ModelRecord modelRecord(const Scene& scene, std::size_t model) {
  ModelRecord record = modelRecord(*scene.models[model]);
  if (model >= scene.sources.size()) return record;
  const ModelSource& source = scene.sources[model];
  record.file = scene.files[source.file].string();
  record.kind = source.kind;
  record.id = source.id;
  record.path = source.path;
  return record;
}

}  // namespace allpairs::scene
