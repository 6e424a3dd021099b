// SPDX-License-Identifier: MIT
//
// Which parts come within a millimetre of which shelves? Two sets against each other, with a distance, a region and a
// limit, on arrays as they come from elsewhere: rows of minx miny minz maxx maxy maxz, float32, in metres.
#include <allpairs/Error.h>
#include <allpairs/Overlaps.h>

#include <array>
#include <iostream>

int main() {
  constexpr std::array<float, 18> kParts{0.1F, 0.1F, 0.0005F, 0.2F, 0.2F, 0.1F,    // just above shelf 0
                                         0.1F, 0.1F, 0.501F,  0.2F, 0.2F, 0.6F,    // above shelf 1, in reach
                                         5.0F, 0.1F, 0.0F,    5.1F, 0.2F, 0.1F};   // on shelf 0, beyond the region
  constexpr std::array<float, 12> kShelves{0.0F, 0.0F, -0.02F, 9.0F, 1.0F, 0.0F,   //
                                           0.0F, 0.0F, 0.48F,  9.0F, 1.0F, 0.5F};  //
  const auto parts = allpairs::BoxView::fromRows(kParts);
  const auto shelves = allpairs::BoxView::fromRows(kShelves);

  allpairs::OverlapOptions options;
  options.distance = 0.00101;
  options.region = allpairs::Box{{0, 0, -1}, {2, 1, 1}};
  options.maxPairs = 1000;
  try {
    for (const auto& [part, shelf] : allpairs::overlaps(parts, shelves, options)) {
      std::cout << "part " << part << " is near shelf " << shelf << '\n';
    }
  } catch (const allpairs::LimitExceeded& error) {
    std::cout << "too crowded: " << error.count() << " pairs and more\n";
  }
}
