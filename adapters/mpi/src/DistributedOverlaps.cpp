// SPDX-License-Identifier: MIT
#include "allpairs/mpi/DistributedOverlaps.h"

#include <array>
#include <optional>

#include "DistributedSearch.h"
#include "Ranks.h"
#include "Tuning.h"
#include "allpairs/Error.h"
#include "allpairs/mpi/OnAllRanks.h"

namespace allpairs::mpi {

struct DistributedOverlaps::State {
  explicit State(const DistributedOptions& given) : options(given) {}

  [[nodiscard]] DistributedSearch search() const { return {*ranks, options, tuning}; }

  DistributedOptions options;
  Tuning tuning{};
  std::optional<Ranks> ranks;
};

DistributedOverlaps::State& DistributedOverlaps::state() {
  if (!m_state) throw InvalidArgument("a DistributedOverlaps that has been moved from");
  requireUsable();
  return *m_state;
}

/// All ranks duplicate the communicator, or none.
DistributedOverlaps::DistributedOverlaps(MPI_Comm communicator, const DistributedOptions& options) {
  onAllRanks(communicator, [&] { m_state = std::make_unique<State>(options); });
  m_state->ranks.emplace(communicator, m_state->tuning.pieceWords);
}
DistributedOverlaps::~DistributedOverlaps() = default;
DistributedOverlaps::DistributedOverlaps(DistributedOverlaps&&) noexcept = default;
DistributedOverlaps& DistributedOverlaps::operator=(DistributedOverlaps&&) noexcept = default;

std::vector<IdPair> DistributedOverlaps::find(const LocalBoxes& boxes) { return state().search().find({&boxes, 1}); }

std::vector<IdPair> DistributedOverlaps::find(const LocalBoxes& first, const LocalBoxes& second) {
  return state().search().find(std::array{first, second});
}

std::uint64_t DistributedOverlaps::count(const LocalBoxes& boxes) { return state().search().count({&boxes, 1}); }

std::uint64_t DistributedOverlaps::count(const LocalBoxes& first, const LocalBoxes& second) {
  return state().search().count(std::array{first, second});
}

}  // namespace allpairs::mpi
