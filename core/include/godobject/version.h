#pragma once

/// The library's version, after https://semver.org. The build reads it from here; no other file repeats it.
#define GODOBJECT_VERSION_MAJOR 0
#define GODOBJECT_VERSION_MINOR 2
#define GODOBJECT_VERSION_PATCH 0
#define GODOBJECT_VERSION "0.2.0"
