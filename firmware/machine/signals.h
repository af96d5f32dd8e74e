#pragma once

#include "firmware/loop/run_requests.h"

namespace godobject::firmware {

/// The requests that signals set. This is the program's only mutable static object: a signal handler gets no argument,
/// so the object that it writes to must have a fixed address.
RunRequests& signal_requests() noexcept;

/// SIGTERM, SIGINT and SIGHUP, which a closed terminal sends, set `signal_requests().end` from now on.
void catch_end_signals() noexcept;

/// SIGUSR1 sets `signal_requests().reset` from now on.
void catch_reset_signal() noexcept;

/// A closed pipe (SIGPIPE) or a file at its size limit (SIGXFSZ) no longer ends the process: the failing write costs
/// records and nothing else.
void ignore_write_signals() noexcept;

}  // namespace godobject::firmware
