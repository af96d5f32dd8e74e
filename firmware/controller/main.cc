#include <string>

#include <CLI/CLI.hpp>

#include "firmware/controller/commission_command.h"
#include "firmware/controller/control_command.h"
#include "firmware/controller/doctor_command.h"
#include "firmware/controller/explain_command.h"
#include "firmware/drives/drive_family.h"
#include "toolchain/command_line/run.h"

int main(int argc, char** argv) {
  using namespace godobject;
  CLI::App app("The haptic controller: reads the drives' positions and sends their torques, once a period.",
               "godobject-controller");
  std::string transport = firmware::kSimulatedTransport;
  firmware::ControlCommand control(app, transport);
  firmware::DoctorCommand doctor(app, transport);
  firmware::CommissionCommand commission(app, transport);
  const firmware::ExplainCommand explain(app);
  return command::run(app, argc, argv, [&] {
    if (commission.is_asked()) return commission.run();
    if (doctor.is_asked()) return doctor.run();
    if (explain.is_asked()) return explain.run();
    control.run();
  });
}
