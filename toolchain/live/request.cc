#include "toolchain/live/request.h"

#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace godobject::live {
namespace {

using nlohmann::json;

constexpr double kFarthest = 100.0;  // of a pose, from W's origin [m]

/// An objection to a message, one clause.
struct Objection {
  std::string text;
};

void require_keys(const json& message, std::initializer_list<const char*> allowed) {
  for (const auto& item : message.items()) {
    bool known = item.key() == "type";
    for (const char* key : allowed) known = known || item.key() == key;
    if (!known) throw Objection{fmt::format("unknown key \"{}\"", item.key())};
  }
}

double number(const json& value, const char* key) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw Objection{fmt::format("\"{}\" has a value that is no number", key)};
  }
  return value.get<double>();
}

std::optional<double> optional_number(const json& message, const char* key) {
  if (!message.contains(key)) return {};
  return number(message[key], key);
}

std::optional<bool> optional_switch(const json& message, const char* key) {
  if (!message.contains(key)) return {};
  if (!message[key].is_boolean()) throw Objection{fmt::format("\"{}\" is neither true nor false", key)};
  return message[key].get<bool>();
}

Pose pose_of(const json& message) {
  if (!message.contains("pose") || !message["pose"].is_array() || message["pose"].size() != 7) {
    throw Objection{"\"pose\" wants x, y, z, qw, qx, qy, qz"};
  }
  double values[7];
  for (std::size_t i = 0; i < 7; ++i) values[i] = number(message["pose"][i], "pose");
  Pose pose{Quaternion(values[3], values[4], values[5], values[6]), Vector3(values[0], values[1], values[2])};
  const double length = pose.rotation.norm();
  if (!(length > 0.99 && length < 1.01)) throw Objection{"\"pose\" has a quaternion that is not of unit length"};
  if (!(pose.translation.norm() < kFarthest)) throw Objection{fmt::format("\"pose\" is {:g} m away", kFarthest)};
  pose.rotation.normalize();
  return pose;
}

std::optional<Solver> optional_solver(const json& message) {
  if (!message.contains("solver")) return {};
  const json& name = message["solver"];
  if (name == "paper") return Solver::kPaper;
  if (name == "corrected") return Solver::kCorrected;
  if (name == "contact") return Solver::kContact;
  throw Objection{"\"solver\" must be contact, corrected or paper"};
}

Request request_of(const json& message) {
  if (!message.is_object() || !message.contains("type")) throw Objection{"not an object with a \"type\""};
  const json& type = message["type"];
  if (type == "hand") {
    require_keys(message, {"pose"});
    return HandRequest{pose_of(message)};
  }
  if (type == "set") {
    require_keys(message, {"solver", "friction", "stiffness", "damping", "beyond"});
    return ChangeRequest{optional_solver(message), optional_switch(message, "friction"),
                         optional_number(message, "stiffness"), optional_number(message, "damping"),
                         optional_switch(message, "beyond").value_or(false)};
  }
  require_keys(message, {});
  if (type == "release") return ReleaseRequest{};
  if (type == "reset") return ResetRequest{};
  throw Objection{"\"type\" must be hand, release, set or reset"};
}

}  // namespace

std::variant<Request, std::string> read_request(std::string_view message) {
  if (message.size() > kLongestMessage) return fmt::format("longer than {} bytes", kLongestMessage);
  const json parsed = json::parse(message, nullptr, false);
  if (parsed.is_discarded()) return "not JSON";
  try {
    return request_of(parsed);
  } catch (const Objection& objection) {
    return objection.text;
  }
}

}  // namespace godobject::live
