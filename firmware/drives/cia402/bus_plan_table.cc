#include "firmware/drives/cia402/bus_plan_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

constexpr double kFastest = 1e6;      // largest bit rate of the arbitration, ISO 11898-1 [bit/s]
constexpr double kFastestData = 8e6;  // of the keys of a device file [bit/s]
constexpr double kHandLever =
    0.5;  // lever with which a torque step is shown as a force; chosen, half an arm's reach [m]

double us(std::int64_t ns) { return 1e-3 * static_cast<double>(ns); }

std::string rates(const hal::BusLayout& layout) {
  if (!layout.fd) return fmt::format("CAN {:g} Mbit/s", 1e-6 * layout.bit_rate);
  return fmt::format("CAN FD {:g}/{:g} Mbit/s", 1e-6 * layout.bit_rate, 1e-6 * layout.data_rate);
}

/// Returns the cure that makes frames shorter.
const char* faster(const hal::BusLayout& layout) {
  if (!layout.fd) return "use CAN FD (bus.fd) ";
  if (!layout.fd_services) return "set bus.fd_services ";
  return layout.data_rate < kFastestData ? "raise bus.data_rate " : "";
}

}  // namespace

std::string bus_plan_table(const hal::BusLayout& layout, const hal::BusPlan& plan) {
  std::string text =
      fmt::format("bus plan: {}, cycle {:g} us, drives answer within {:g} us, computing {:g} us; worst case in us\n",
                  rates(layout), 1e6 * layout.period, 1e6 * layout.answer, 1e6 * layout.compute);
  text += "bus joints panel   SYNC  TPDOs  RPDOs    end  with SDO  wire busy\n";
  auto out = std::back_inserter(text);
  for (std::size_t bus = 0; bus < static_cast<std::size_t>(layout.bus_count); ++bus) {
    const hal::BusLoad& load = plan.buses[bus];
    fmt::format_to(out, "{:>3} {:>6} {:>5} {:>6.0f} {:>6.0f} {:>6.0f} {:>6.0f} {:>9.0f} {:>8.1f} %{}\n", bus,
                   load.joints, load.panel ? "yes" : "no", us(load.sync_ns), us(load.samples_ns), us(load.torques_ns),
                   us(load.end_ns), us(load.slot_ns), 100 * load.utilisation, load.fits ? "" : "  does not fit");
  }
  fmt::format_to(out, "samples collected {:.0f} us after SYNC; from sample to torque at most {:.0f} us\n",
                 us(plan.timing.collect_ns), 1e6 * plan.timing.delay_s);
  for (std::size_t joint = 0; joint < static_cast<std::size_t>(layout.joint_count); ++joint) {
    const double step = plan.torque_step[joint];
    fmt::format_to(out, "joint {}: bus {}, node {}, torque in steps of {:.3g} Nm, {:.2g} N at {:g} m\n", joint + 1,
                   layout.drives[joint].bus, layout.drives[joint].node, step, step / kHandLever, kHandLever);
  }
  return text;
}

std::string bus_plan_objection(const hal::BusLayout& layout, const hal::BusPlan& plan) {
  for (std::size_t bus = 0; bus < static_cast<std::size_t>(layout.bus_count); ++bus) {
    const hal::BusLoad& load = plan.buses[bus];
    if (load.fits) continue;
    return fmt::format(
        "bus {}: a cycle needs {:.0f} us of {:.0f} with {} joint{}{}; {}{}lower loop.compute ({:.0f} us), {}or raise "
        "bus.period",
        bus, us(std::max(load.end_ns, load.slot_ns)), 1e6 * layout.period, load.joints, load.joints == 1 ? "" : "s",
        load.panel ? " and the panel" : "", load.joints + (load.panel ? 1 : 0) > 1 ? "put fewer on it, " : "",
        layout.bit_rate < kFastest ? "raise bus.bit_rate, " : "", 1e6 * layout.compute, faster(layout));
  }
  return "";
}

}  // namespace godobject::firmware
