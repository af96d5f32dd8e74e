#include "firmware/incidents/hand_motion.h"

namespace godobject::firmware {
namespace {

/// The row over whose distance the controller estimates velocities.
std::size_t row_before(const Incident& incident, std::size_t row) {
  constexpr double kRounding = 1e-6;  // of times in telemetry.csv [s]
  const double span = incident.bounds.value_or(IncidentBounds{}).velocity_span - kRounding;
  std::size_t before = row;
  while (before > 0 && incident.rows[row].t - incident.rows[before].t < span) --before;
  return before;
}

}  // namespace

double hand_speed(const Incident& incident, std::size_t row) {
  const IncidentRow& now = incident.rows[row];
  const IncidentRow& before = incident.rows[row_before(incident, row)];
  if (!(now.t > before.t)) return 0.0;
  const double scale = incident.bounds ? incident.bounds->scale : 1.0;
  return (now.H_WD.translation - before.H_WD.translation).norm() / (now.t - before.t) / scale;
}

double hand_turn(const Incident& incident, std::size_t row) {
  const IncidentRow& now = incident.rows[row];
  const IncidentRow& before = incident.rows[row_before(incident, row)];
  if (!(now.t > before.t)) return 0.0;
  return now.H_WD.rotation.normalized().angularDistance(before.H_WD.rotation.normalized()) / (now.t - before.t);
}

}  // namespace godobject::firmware
