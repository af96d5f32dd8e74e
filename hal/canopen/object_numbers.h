#pragma once

#include <cstdint>

/// Numbers of CiA 301, CiA 401 and CiA 402.
namespace godobject::hal::canopen {

/// COB-IDs. For messages of a node this is the base: COB-ID = base + node, 1 to 127.
enum Cob : std::uint16_t {
  kCobNmt = 0x000,
  kCobSync = 0x080,
  kCobEmergency = 0x080,
  kCobTpdo1 = 0x180,
  kCobRpdo1 = 0x200,
  kCobTpdo2 = 0x280,
  kCobSdoResponse = 0x580,
  kCobSdoRequest = 0x600,
  kCobHeartbeat = 0x700,
};

enum NmtCommand : std::uint8_t {
  kNmtStart = 0x01,
  kNmtStop = 0x02,
  kNmtPreOperational = 0x80,
  kNmtResetNode = 0x81,
  kNmtResetCommunication = 0x82,
};

enum NmtState : std::uint8_t {
  kNmtBoot = 0x00,
  kNmtStopped = 0x04,
  kNmtOperational = 0x05,
  kNmtPreOperationalState = 0x7F,
};

/// Indices of the object dictionary.
enum Object : std::uint16_t {
  kDeviceType = 0x1000,
  kErrorRegister = 0x1001,
  kSyncCob = 0x1005,
  kSyncPeriod = 0x1006,
  kEmergencyCob = 0x1014,
  kConsumerHeartbeat = 0x1016,
  kProducerHeartbeat = 0x1017,
  kIdentity = 0x1018,
  kSyncOverflow = 0x1019,
  kErrorBehaviour = 0x1029,
  kRpdo1Communication = 0x1400,
  kRpdo1Mapping = 0x1600,
  kTpdo1Communication = 0x1800,
  kTpdo2Communication = 0x1801,
  kTpdo1Mapping = 0x1A00,
  kTpdo2Mapping = 0x1A01,
  kAbortConnectionOption = 0x6007,
  kErrorCode = 0x603F,
  kControlword = 0x6040,
  kStatusword = 0x6041,
  kQuickStopOption = 0x605A,
  kFaultReactionOption = 0x605E,
  kMode = 0x6060,
  kModeDisplay = 0x6061,
  kPosition = 0x6064,
  kVelocity = 0x606C,
  kTargetTorque = 0x6071,
  kMaxTorque = 0x6072,
  kTorqueDemand = 0x6074,
  kMotorRatedCurrent = 0x6075,
  kMotorRatedTorque = 0x6076,
  kActualTorque = 0x6077,
  kPolarity = 0x607E,
  kQuickStopDeceleration = 0x6085,
  kEncoderResolution = 0x608F,
  kGearRatio = 0x6091,
  kInterpolationPeriod = 0x60C2,
  kPositiveTorqueLimit = 0x60E0,
  kNegativeTorqueLimit = 0x60E1,
  kSupportedModes = 0x6502,
  kDigitalInputs8 = 0x6000,  ///< CiA 401: inputs of the operator's panel
  kInputPolarity8 = 0x6002,  ///< CiA 401: a bit of 1 inverts its input
};

inline constexpr std::int8_t kModeTorque = 10;                    ///< cyclic synchronous torque
inline constexpr std::uint32_t kSupportsTorque = 1u << 9;         ///< bit of that mode in 6502
inline constexpr std::uint32_t kServoDrive = 0x00020192;          ///< 1000: CiA 402, servo drive
inline constexpr std::uint32_t kDigitalInputModule = 0x00010191;  ///< 1000: CiA 401 with digital inputs

/// Bits of 6000:1 of the operator's panel. A closed circuit reads 1, so a broken wire is safe.
inline constexpr std::uint8_t kPanelStopReleased = 1u << 0;  ///< 0: emergency stop pressed
inline constexpr std::uint8_t kPanelEnable = 1u << 1;        ///< 1: the enable switch is held
inline constexpr std::uint8_t kPanelClutch = 1u << 2;        ///< 1: the clutch is open

}  // namespace godobject::hal::canopen
