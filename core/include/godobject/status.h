#pragma once

#include <cstdint>

namespace godobject {

/// The result of a call of the core. Outputs are valid only on `kOk`, unless the call says otherwise.
enum class [[nodiscard]] Status : std::uint8_t{
    kOk = 0,          ///< success
    kNotFinite,       ///< an input is NaN or Inf, or the result would have been
    kNotUnit,         ///< a quaternion's length differs from 1 by more than 1e-3
    kOutOfRange,      ///< a coordinate of a pose is beyond 1e7 m, or a gain is out of its range
    kImageTruncated,  ///< scene image: fewer or more bytes than its header says
    kImageForeign,    ///< not a scene image, or one of another byte order
    kImageVersion,    ///< scene image: its format version is not this library's; compile it again
    kImageChecksum,   ///< scene image: a checksum does not match; the file is damaged
    kImageLayout,     ///< scene image: not aligned, or a section is missing, misplaced or of the wrong size
    kImageValue,      ///< scene image: a number is out of its range
    kNotInImage,      ///< the image was compiled without the requested solver or friction
    kNotInBuild,      ///< this build leaves out the requested solver, friction, or a part that the scene needs
    kMemory,          ///< the memory for a session is too small or not aligned
    kNotStarted,      ///< `start` has not succeeded yet
    kArmShape,        ///< arm: the joint count is out of range, or a rotation is not of unit length
    kArmMass,         ///< arm: a mass or inertia tensor is not physical
    kArmLimits,       ///< arm: position, velocity or torque limits are inconsistent
    kArmControl,      ///< arm: a parameter of the joint torques is out of its range
};

/// Returns the status as one clause for the user, in lower case, without a full stop. Never null.
constexpr const char* describe(Status status) noexcept {
  switch (status) {
    case Status::kOk: return "ok";
    case Status::kNotFinite: return "a number is not finite";
    case Status::kNotUnit: return "a quaternion is not of unit length";
    case Status::kOutOfRange: return "a pose or a gain is out of range";
    case Status::kImageTruncated: return "the scene image is truncated or has extra bytes";
    case Status::kImageForeign: return "not a scene image of this machine's byte order";
    case Status::kImageVersion: return "the scene image has the format of another version";
    case Status::kImageChecksum: return "the scene image is damaged (checksum)";
    case Status::kImageLayout: return "a section of the scene image is missing or misplaced";
    case Status::kImageValue: return "a value in the scene image is out of range";
    case Status::kNotInImage: return "the scene image was compiled without the requested solver or friction";
    case Status::kNotInBuild: return "this build leaves out the requested solver or a part that the scene needs";
    case Status::kMemory: return "the memory for the god object is too small or not aligned";
    case Status::kNotStarted: return "the god object has not been started";
    case Status::kArmShape: return "the arm's joint count or one of its rotations is invalid";
    case Status::kArmMass: return "the arm has a mass or inertia that is not physical";
    case Status::kArmLimits: return "the arm's position, velocity or torque limits are inconsistent";
    case Status::kArmControl: return "a parameter of the joint torques is out of range";
  }
  return "unknown status";
}

}  // namespace godobject
