#pragma once

/// @file
/// Version of the library, after https://semver.org. The build reads it from here; no other file repeats it.
#define GODOBJECT_VERSION_MAJOR 0  ///< incompatible changes
#define GODOBJECT_VERSION_MINOR 2  ///< additions; below 1.0 incompatible changes too
#define GODOBJECT_VERSION_PATCH 0  ///< corrections
#define GODOBJECT_VERSION "0.2.0"  ///< major.minor.patch
