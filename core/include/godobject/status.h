#pragma once

#include <cstdint>

namespace godobject {

/// What a call of the core ended with. Outputs mean something only on `kOk`.
enum class [[nodiscard]] Status : std::uint8_t{
    kOk = 0,
    kNotFinite,       ///< any step: a NaN or Inf came in, or would have left the step
    kNotUnit,         ///< a quaternion further than 1e-3 from unit length
    kOutOfRange,      ///< a pose farther out than any scene reaches
  kImageTruncated,  ///< scene image: fewer bytes than it says it has, or more
    kImageForeign,    ///< scene image: not one at all, or of another byte order
    kImageVersion,    ///< scene image: made by another version of the compiler
    kImageChecksum,   ///< scene image: a bit is wrong
    kImageLayout,     ///< scene image: a section is missing, misplaced, or of the wrong size
    kImageValue,      ///< scene image: a number in it is out of its range
    kNotInImage,      ///< the solver or the friction asked for was left out of this image
    kNotInBuild,      ///< this build is one for another scene, without what is asked for
    kMemory,          ///< the memory for a session is too small or not aligned
    kNotStarted,      ///< an update before `start` succeeded
    kArmShape,        ///< arm: joint count, or a rotation that is not of unit length
    kArmMass,         ///< arm: a mass or inertia tensor that no body has
    kArmLimits,       ///< arm: position, velocity or torque limits out of order
    kArmControl,      ///< arm: a parameter of the joint torques out of its range
};

/// One clause in lower case, without a full stop, for the user's eye. Never null.
constexpr const char* describe(Status status) noexcept {
  switch (status) {
    case Status::kOk: return "ok";
    case Status::kNotFinite: return "a number is not finite";
    case Status::kNotUnit: return "a quaternion is not of unit length";
    case Status::kOutOfRange: return "a pose is farther out than any scene";
    case Status::kImageTruncated: return "the scene image is cut short or has bytes too many";
    case Status::kImageForeign: return "not a scene image of this machine's byte order";
    case Status::kImageVersion: return "the scene image was made by another version";
    case Status::kImageChecksum: return "the scene image is damaged (checksum)";
    case Status::kImageLayout: return "a section of the scene image is missing or misplaced";
    case Status::kImageValue: return "a value in the scene image is out of range";
    case Status::kNotInImage: return "the scene image was compiled without what is asked for";
    case Status::kNotInBuild: return "this build is for another scene and without what is asked for";
    case Status::kMemory: return "the memory for the god object is too small or not aligned";
    case Status::kNotStarted: return "the god object has not been started";
    case Status::kArmShape: return "the arm's joint count or one of its rotations is not possible";
    case Status::kArmMass: return "the arm has a mass or inertia that no body has";
    case Status::kArmLimits: return "the arm's position, velocity or torque limits are out of order";
    case Status::kArmControl: return "a parameter of the joint torques is out of range";
  }
  return "unknown status";
}

}  // namespace godobject
