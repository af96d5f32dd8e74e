#include "toolchain/path/shake.h"

#include <numbers>
#include <random>

namespace godobject::path {

void shake(std::uint64_t seed, Keyframes& motion) {
  constexpr int kSines = 3;
  constexpr double kTranslation = 1e-3;  // [m]
  constexpr double kRotation = 0.02;     // [rad]
  constexpr double kFade = 0.3;          // [s]
  std::mt19937_64 random(seed);
  // the distributions of the standard library may differ from machine to machine
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) / 9007199254740992.0);
  };
  for (int coordinate = 0; coordinate < 6; ++coordinate) {
    for (int sine = 0; sine < kSines; ++sine) {
      Oscillation wave;
      wave.from = motion.keyframes.front().t;
      wave.to = motion.keyframes.back().t;
      wave.fade = kFade;
      wave.frequency = between(0.1, 1.5);
      wave.phase = between(0.0, 2.0 * std::numbers::pi);
      const double share = between(-1.0, 1.0);
      if (coordinate < 3) {
        wave.translation[coordinate] = share * kTranslation;
      } else {
        wave.rotation[coordinate - 3] = share * kRotation;
      }
      motion.oscillations.push_back(wave);
    }
  }
}

}  // namespace godobject::path
