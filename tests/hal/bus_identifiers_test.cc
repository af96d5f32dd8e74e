#include "hal/cia402/bus_identifiers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace godobject::hal {
namespace {

std::vector<std::uint16_t> sorted(const BusIdentifiers& identifiers) {
  std::vector<std::uint16_t> all(identifiers.all().begin(), identifiers.all().end());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(BusIdentifiers, AreThoseOfTheNodesOnTheBus) {
  BusLayout layout;
  layout.bus_count = 3;
  layout.joint_count = 2;
  layout.drives[0].node = 5;
  layout.drives[1].bus = 1;
  layout.drives[1].node = 5;
  layout.panel = {1, 0x20};
  EXPECT_EQ(sorted(BusIdentifiers(layout, 0)),
            (std::vector<std::uint16_t>{0x000, 0x080, 0x085, 0x100, 0x185, 0x205, 0x285, 0x305, 0x405, 0x505, 0x585,
                                        0x605, 0x705, 0x77F, 0x7E5}));
  EXPECT_EQ(sorted(BusIdentifiers(layout, 1)),
            (std::vector<std::uint16_t>{0x000, 0x080, 0x085, 0x0A0, 0x100, 0x185, 0x1A0, 0x205, 0x220,
                                        0x285, 0x2A0, 0x305, 0x320, 0x405, 0x420, 0x505, 0x520, 0x585,
                                        0x5A0, 0x605, 0x620, 0x705, 0x720, 0x77F, 0x7E5}));
  EXPECT_EQ(sorted(BusIdentifiers(layout, 2)), (std::vector<std::uint16_t>{0x000, 0x080, 0x100, 0x77F, 0x7E5}));
}

TEST(BusIdentifiers, HoldAllJointsAndThePanelOnOneBus) {
  BusLayout layout;
  layout.joint_count = kMaxJoints;
  for (int i = 0; i < kMaxJoints; ++i) layout.drives[static_cast<std::size_t>(i)].node = 120 + i;
  layout.panel.bus = 0;
  const std::vector<std::uint16_t> all = sorted(BusIdentifiers(layout, 0));
  EXPECT_EQ(all.size(), 5u + 10u * 8u);
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  EXPECT_LE(all.back(), 0x7FF);
}

}  // namespace
}  // namespace godobject::hal
