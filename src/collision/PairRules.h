// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ModelTable.h"
#include "allpairs/collision/BroadPhaseDetection.h"
#include "allpairs/collision/PairVerdict.h"

namespace allpairs::collision {

/// The seed's rules for a pair of models, in the seed's order.
///
/// Of models and methods that are the library's own the rules are answered from the table; those of users are asked
/// through their virtual functions. judge() always asks, and serves as the plain double loop.
class PairRules {
 public:
  explicit PairRules(const ModelTable& models) : m_models(models) {}

  /// Looks at a method.
  ///
  /// Bad input: a method whose maximumDistance() is NaN or -infinity throws InvalidArgument.
  void setMethod(Intersection* method);

  /// Forgets the method, and which types of root go with which number.
  void forget() { m_method = nullptr; }

  /// Whether what is known of the method is out of date.
  [[nodiscard]] bool isOutdated(const Intersection* method) const {
    return method != m_method || method->revision() != m_revision;
  }

  /// How far apart root boxes may be, as the method says; and whether the models' contact distances come on top.
  [[nodiscard]] double maximumDistance() const { return m_maximumDistance; }
  [[nodiscard]] bool addsContactDistances() const { return m_addsContactDistances; }

  /// Whether a search with exactly the method's distance has already decided about the boxes.
  [[nodiscard]] bool searchIsExact() const {
    return m_methodIsOurs && !(m_addsContactDistances && m_models.anyContactDistance());
  }

  /// Whether every pair is decided by what the table notes of both models, and reported newest first.
  [[nodiscard]] bool arePlain();

  /// Whether two models of plain rules are a pair. `boxesAreNear`: a search has tested the boxes.
  [[nodiscard]] bool askPlain(std::size_t newer, std::size_t older, bool boxesAreNear) const {
    const ModelRow& a = m_models.row(newer);
    const ModelRow& b = m_models.row(older);
    return ((a.flags | b.flags) & ModelRow::kSimulated) != 0 && m_models.letsCollide(a, b) &&
           m_models.letsCollide(b, a) && (boxesAreNear || this->boxesAreNear(newer, older));
  }

  /// Whether two rows are the same model, added twice. Its root is then asked about itself, which takes its
  /// intersector.
  [[nodiscard]] bool areOneModel(std::size_t newer, std::size_t older) const {
    const ModelRow& a = m_models.row(newer);
    const ModelRow& b = m_models.row(older);
    return a.owner == b.owner && a.model->getLast() == b.model->getLast();
  }

  /// The pair to report for two rows of the table, if there is one. `boxesAreNear`: a search has tested the boxes.
  [[nodiscard]] std::optional<CollisionModelPair> ask(std::size_t newer, std::size_t older, bool boxesAreNear);

  /// The pair to report for two rows, or the rule that there is none by.
  struct Judgement {
    PairRule rule = PairRule::None;
    std::optional<CollisionModelPair> pair{};
  };

  /// The same by the virtual functions of models, method and intersector alone.
  [[nodiscard]] Judgement judge(std::size_t newer, std::size_t older) const;

  /// Whether a root may touch another's, or its own, asked through the method: None, NoIntersector or Apart.
  [[nodiscard]] static PairRule ruleOfRoots(CollisionModel* first, CollisionModel* second, Intersection& method);

 private:
  enum class Kind : unsigned char { Unknown, None, Boxes, Custom };

  /// What serves two types of root.
  struct Link {
    Kind kind = Kind::Unknown;
    bool swap = false;
    ElementIntersector* intersector = nullptr;
  };

  [[nodiscard]] bool keeps(const ModelRow& newer, const ModelRow& older) const;
  [[nodiscard]] static PairRule refusalOf(const ModelRow& a, const ModelRow& b);
  void countTypes();
  [[nodiscard]] Link linkOf(const ModelRow& newer, const ModelRow& older);
  [[nodiscard]] Link findLink(CollisionModel* newer, CollisionModel* older) const;
  [[nodiscard]] bool boxesAreNear(std::size_t first, std::size_t second) const;

  const ModelTable& m_models;
  Intersection* m_method = nullptr;
  std::uint64_t m_revision = 0;
  double m_maximumDistance = 0.0;
  bool m_addsContactDistances = false;
  bool m_methodIsOurs = false;
  std::size_t m_types = 0;
  std::vector<Link> m_links;  // by (type of newer, type of older), for m_types types; of the method at m_revision
};

}  // namespace allpairs::collision
