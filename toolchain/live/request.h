#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "godobject/pose.h"
#include "godobject/scene.h"

namespace godobject::live {

/// The hand shall pull the moving mesh to this pose in the scene.
struct HandRequest {
  Pose H_WM;
};

/// The hand shall stay where it is, for others to take.
struct ReleaseRequest {};

/// The rendering shall change; what has no value stays.
struct ChangeRequest {
  std::optional<Solver> solver = {};
  std::optional<bool> friction = {};
  std::optional<double> stiffness = {};  ///< k_D [N/m]
  std::optional<double> damping = {};    ///< b_D [Ns/m]
  bool beyond = false;                   ///< also beyond the stability boundary
};

/// The run shall begin again after a fault.
struct ResetRequest {};

using Request = std::variant<HandRequest, ReleaseRequest, ChangeRequest, ResetRequest>;

/// Longest message of a page [bytes].
inline constexpr std::size_t kLongestMessage = 4096;

/// Reads a message of a page (README.md). The rotation of a pose is normalised. Returns an error, one clause, for
/// anything else than a request with exactly the keys and kinds of values that it may have.
std::variant<Request, std::string> read_request(std::string_view message);

}  // namespace godobject::live
