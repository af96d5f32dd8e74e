# Functions for the cases with the seven joints of firmware/controllers/lwr.toml, under gravity. They source this file.
source tests/hil/two_processes.bash

# Writes $config. In FD frames the joints are on three buses. In classical frames they are on four: with three joints on a
# bus the plan leaves 120 us for computing, with two 350 us, and the guest's one processor needs up to 320 us.
configure_seven_joints() {  # fd|classical
  local device_file=$HIL_WORK/device.toml compute
  config=$HIL_WORK/seven.toml
  case $1 in
    fd)
      sed "s|^\[bus\]|[bus]\nfd = true|" firmware/devices/lwr.toml >"$device_file"
      compute=0.00045 ;;
    classical)
      awk '/^bus = / { print "bus = " int((joints++) / 2); next } /^panel_bus = / { print "panel_bus = 3"; next } { print }' \
        firmware/devices/lwr.toml >"$device_file"
      compute=0.00035
      use_buses vcan0 vcan1 vcan2 vcan3 ;;
  esac
  sed "s|= \"../devices/lwr.toml\"|= \"$device_file\"|; s|= \"../../toolchain|= \"$PWD/toolchain|
    s|^\[loop\]|[loop]\nreal_time = true\ncompute = $compute\ncycle_budget = 0|" firmware/controllers/lwr.toml >"$config"
}

# Lets the hand begin shortly before the teapot, without the sign test. Its speed is that of firmware/controllers/lwr.toml.
begin_at_the_teapot() {  # SECOND of the path
  awk -F , -v begin="$1" 'NR == 1 { print; next }
    $1 >= begin { row = sprintf("%.3f", $1 - begin); for (i = 2; i <= NF; ++i) row = row "," $i; print row }' \
    toolchain/scenes/paths/bunny-teapot.csv >"$HIL_WORK/path.csv"
  sed -i "s|= .*paths/bunny-teapot.csv\"|= \"$HIL_WORK/path.csv\"|; s|^begin = .*|begin = 1.8|
    s|^start = .*|start = [$(sed -n 2p "$HIL_WORK/path.csv" | cut -d , -f 2-)]|" "$config"
  printf '\n[start]\nsign_test = false\n\n[engage]\nramp = 0.1\n' >>"$config"
}

# Runs the arm into contact: nothing is late or lost. HIL_SECONDS of 30 or more follows the whole path, after the sign test.
run_seven_joints() {  # fd|classical
  local seconds=${HIL_SECONDS:-4} code=0
  configure_seven_joints "$1"
  if [ "$seconds" -ge 30 ]; then
    sed -i "s|^slower = .*|slower = $(((seconds - 7) / 2))|" "$config"
  else
    begin_at_the_teapot 0.393
  fi
  start_device 1.5
  "$HIL_BIN/godobject-controller" "$config" --scene "$HIL_SCENE" --bus "$devices" --duration "$seconds" \
    >"$HIL_WORK/controller" 2>&1 || code=$?
  sed -E "s/^.* us(, | of |\$).*/& ($HIL_CLOCK)/" "$HIL_WORK/controller"
  [ "$code" -eq 0 ] || fail "exit $code"
  end_device
  # 1000 cycles and more are in contact
  grep -qE "in contact in [0-9]{4,}" "$HIL_WORK/controller" || fail "no contact, or hardly"
  not_late
}
