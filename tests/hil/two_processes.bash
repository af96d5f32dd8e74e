# Functions for the cases, which source this file: the simulated arm and the controller as two processes on SocketCAN.
set -euo pipefail

config=tests/hil/controller.toml
log=$HIL_WORK/log
device="" controller=""
trap 'kill -9 $device $controller 2>/dev/null || true' EXIT

use_buses() {  # NAME ...
  local bus
  for bus in "$@"; do ip link set "$bus" up; done
  devices=$(IFS=,; echo "$*")
}
use_buses vcan0 vcan1 vcan2

fail() {
  echo "FAILED: $1"
  echo "--- device"
  cat "$HIL_WORK/device"
  echo "--- controller"
  cat "$HIL_WORK/controller"
  tail -n 3 "$log/telemetry.csv" 2>/dev/null | cut -c1-200
  exit 1
}

# Starts the arm, at a lower priority than the controller's, because the controller sleeps while the arm answers.
start_device() {  # [SECONDS until the operator holds the enable switch: shortly after the controller begins to wait for it]
  chrt -f 70 "$HIL_BIN/godobject-simdevice" "$config" --scene "$HIL_SCENE" --bus "$devices" --enable-after "${1:-0.9}" \
    >"$HIL_WORK/device" 2>&1 &
  device=$!
  sleep 0.1
}

start_controller() {  # [ARGUMENT ...]
  rm -rf "$log"
  mkdir -p "$log"
  "$HIL_BIN/godobject-controller" "$config" --scene "$HIL_SCENE" --bus "$devices" --log "$log" "$@" >"$HIL_WORK/controller" 2>&1 &
  controller=$!
}

mode() { tail -n 1 "$log/telemetry.csv" 2>/dev/null | cut -d , -f 4; }

# Waits in steps of 100 ms, because each check takes the virtual machine some milliseconds.
until_mode() {  # MODE SECONDS
  local i
  for ((i = 0; i < 10 * $2; ++i)); do
    [ "$(mode)" != "$1" ] || return 0
    kill -0 "$controller" 2>/dev/null || fail "the controller has ended before the mode $1"
    sleep 0.1
  done
  fail "not in the mode $1 within $2 s, but $(mode)"
}

start_running() {
  start_device
  start_controller
  until_mode running 15
}

# Kills the controller and waits until the drives have noticed.
kill_controller() {
  kill -KILL "$controller"
  wait "$controller" || true
  controller=""
  sleep 0.6
}

# Checks that each drive has stopped by itself. After end_device.
all_have_stopped() {  # JOINTS
  [ "$(grep -cE '^joint .* [1-9] trips, (switch on disabled|fault)$' "$HIL_WORK/device")" -eq "$1" ] || fail "not all drives have stopped"
}

# Checks the telemetry after the last row in the mode running: no later mode may power the arm again.
never_again() {
  awk -F , '$4 == "running" { last = NR } { mode[NR] = $4 }
    END { for (i = last + 1; i <= NR; ++i) if (mode[i] !~ /^(fade|stopping|stopped|ending|ended)$/) { print "row " i ": " mode[i]; exit 1 } }' \
    "$log/telemetry.csv" || fail "powered again"
}

# For disturbances without effect: the controller still runs after a moment (goes_on_running), then ends in order (goes_on).
goes_on_running() {
  sleep 0.1
  [ "$(mode)" = running ] || fail "not running, but $(mode)"
}

goes_on() {
  goes_on_running
  kill -TERM "$controller"
  wait "$controller" || fail "the controller ended with $?"
  controller=""
  never_again
  grep 'positions lost' "$HIL_WORK/controller"
}

# Checks that nothing was late or lost and that there was no page fault. Only in virtual time, because delays of a machine
# without a real-time kernel are not the controller's fault. One late sample of each joint is allowed: during the silence
# of the controller's probe the arm follows its own clock, so its first answers after that may be late. Lost positions
# count from the next mode on.
not_late() {
  [ "$HIL_CLOCK" = "virtual time" ] || return 0
  grep -q 'positions lost in 0 cycles, jumps in 0, sends failed 0, overruns 0, periods skipped 0' "$HIL_WORK/controller" ||
    fail "late or lost"
  grep -q 'longer than loop.compute in 0$' "$HIL_WORK/controller" || fail "computed for longer than planned"
  grep -qE 'samples lost [0-7], late [0-7]; malformed 0, queue full 0, floods 0' "$HIL_WORK/controller" || fail "frames lost or late"
  grep -q 'page faults in the loop: 0' "$HIL_WORK/controller" || fail "page faults"
}

# Ends the arm with SIGTERM and prints its output.
end_device() {
  kill -TERM "$device" 2>/dev/null || true
  wait "$device" || fail "the device ended with $?"
  device=""
  cat "$HIL_WORK/device"
}

# Checks a fault that the controller must find: it stops, stays stopped until SIGTERM, and stderr has the words of the fault.
stopped_by() {  # WORDS
  until_mode stopped 2
  sleep 0.1
  [ "$(mode)" = stopped ] || fail "not latched: $(mode)"
  kill -TERM "$controller"
  wait "$controller" || true
  controller=""
  grep -q "stopped: .*$1" "$HIL_WORK/controller" || fail "no word of '$1'"
  never_again
  grep 'stopped:' "$HIL_WORK/controller"
}
