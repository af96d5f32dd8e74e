#include "toolchain/report/contact_quality/table.h"

#include <cmath>

#include <gtest/gtest.h>

namespace godobject::report {
namespace {

using format::Solver;

std::vector<Measurement> some() {
  return {{"ball", "analytic", Solver::kPaper, Quantity::kOptimum, 1.5},
          {"ball", "analytic", Solver::kContact, Quantity::kOptimum, 0.02},
          {"box", "compiled", Solver::kContact, Quantity::kOptimum, 0.0612},
          {"box", "moved", Solver::kContact, Quantity::kOptimum, 0.03},
          {"ball", "analytic", Solver::kContact, Quantity::kSolveMedian, 0.2},
          {"box", "compiled", Solver::kContact, Quantity::kSolveMedian, 0.9},
          {"peg", "compiled", Solver::kContact, Quantity::kSolveMedian, 0.3},
          {"ball", "analytic", Solver::kContact, Quantity::kPenetration, 2e-7}};
}

TEST(Judge, TakesTheWorstScene) {
  const auto verdict = judge(some(), Quantity::kOptimum, Solver::kContact);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->value, 0.0612);
  EXPECT_EQ(verdict->worst_scene, "box (compiled)");
  EXPECT_FALSE(verdict->held);
}

TEST(Judge, TakesTheMedianOfTimes) {
  const auto verdict = judge(some(), Quantity::kSolveMedian, Solver::kContact);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->value, 0.3);
  EXPECT_TRUE(verdict->held);
}

TEST(Judge, NamesNoSceneWhereNothingIsWrong) {
  const auto verdict =
      judge({{"ball", "moved", Solver::kContact, Quantity::kCrossings, 0.0}}, Quantity::kCrossings, Solver::kContact);
  ASSERT_TRUE(verdict);
  EXPECT_TRUE(verdict->held);
  EXPECT_EQ(verdict->worst_scene, "");
}

TEST(Judge, SaysNothingOfWhatWasNotMeasured) {
  EXPECT_FALSE(judge(some(), Quantity::kDrag, Solver::kContact));
  EXPECT_FALSE(judge(some(), Quantity::kOptimum, Solver::kCorrected));
}

TEST(Judge, HoldsWhatIsNoNumberToBeTheWorst) {
  auto measurements = some();
  measurements.insert(measurements.begin() + 1,
                      {"needle", "analytic", Solver::kContact, Quantity::kOptimum, std::nan("")});
  const auto verdict = judge(measurements, Quantity::kOptimum, Solver::kContact);
  EXPECT_TRUE(std::isnan(verdict->value));
  EXPECT_EQ(verdict->worst_scene, "needle (analytic)");
  EXPECT_FALSE(verdict->held);
  EXPECT_EQ(verdict_text(spec(Quantity::kOptimum), verdict), "missed: a cycle failed");
}

TEST(VerdictText, SaysByHowMuchATargetIsMissed) {
  const auto text = [](Quantity quantity) {
    return verdict_text(spec(quantity), judge(some(), quantity, Solver::kContact));
  };
  EXPECT_EQ(text(Quantity::kOptimum), "missed by 0.0212 mm");
  EXPECT_EQ(text(Quantity::kSolveMedian), "held");
  EXPECT_EQ(text(Quantity::kPenetration), "missed by 2.0e-07 mm");  // never "by 0.0000"
  EXPECT_EQ(text(Quantity::kDrag), "not run");
  EXPECT_EQ(text(Quantity::kExcess), "-");
}

TEST(TextTable, HasOneLineForEachQuantityMeasured) {
  EXPECT_EQ(text_table(some()),
            "quantity                 unit  target   paper  corrected  contact  verdict on contact    worst scene of "
            "contact\n"
            "penetration (field)      mm         0       -          -   0.0000  missed by 2.0e-07 mm  ball (analytic)\n"
            "distance to the optimum  mm      0.04  1.5000          -   0.0612  missed by 0.0212 mm   box (compiled)\n"
            "solver, median           us       0.5       -          -     0.30  held\n");
}

TEST(Notes, SayWhyAMissedTargetIsMissedAndOnlyThen) {
  EXPECT_NE(notes(some()).find("distance to the optimum is missed: "), std::string::npos);
  EXPECT_EQ(notes(some()).find("solver, median is missed"), std::string::npos);
}

TEST(Notes, ExplainTheUnit) { EXPECT_NE(notes(some()).find("voxels: voxel edges of the scene"), std::string::npos); }

TEST(SummaryCsv, HasAllQuantitiesAndTheSameColumnsEverywhere) {
  const std::string text = summary_csv(some());
  std::size_t lines = 0;
  for (std::size_t begin = 0; begin < text.size(); ++lines) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                         text.begin() + static_cast<std::ptrdiff_t>(end), ','),
              9);
    begin = end + 1;
  }
  EXPECT_EQ(lines, quantities().size() + 1);
  EXPECT_NE(text.find("optimum_distance,mm,0.04,1.5,,0.0612,ball (analytic),,box (compiled),missed by 0.0212 mm\n"),
            std::string::npos);
}

TEST(MeasurementsCsv, HasARowForEachMeasurement) {
  const std::string text = measurements_csv(some());
  EXPECT_NE(text.find("box,compiled,contact,optimum_distance,mm,0.0612,0.04,missed\n"), std::string::npos);
  EXPECT_NE(text.find("ball,analytic,contact,solve_median,us,0.2,0.5,held\n"), std::string::npos);
}

}  // namespace
}  // namespace godobject::report
