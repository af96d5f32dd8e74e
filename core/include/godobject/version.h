#pragma once

/// Version of the library, after https://semver.org. The build reads it from here; it stands nowhere else.
#define GODOBJECT_VERSION_MAJOR 0
#define GODOBJECT_VERSION_MINOR 2
#define GODOBJECT_VERSION_PATCH 0
#define GODOBJECT_VERSION "0.2.0"
