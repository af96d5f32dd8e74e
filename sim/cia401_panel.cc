#include "sim/cia401_panel.h"

namespace godobject::sim {

using namespace hal::canopen;

Cia401Panel::Cia401Panel(const hal::PanelConfig& config, bool fd) noexcept
    : CanopenNode(config.node, kDigitalInputModule, 255, fd) {
  objects().set_initial(kTpdo1Mapping, 0, 1);
  objects().set_initial(kTpdo1Mapping, 1, 0x6000'0108);
  objects().add({kDigitalInputs8, 0, ObjectType::kU8, ObjectAccess::kConst, Mapping::kNo, 1});
  objects().add({kDigitalInputs8, 1, ObjectType::kU8, ObjectAccess::kReadOnly, Mapping::kToNetwork, 0});
  objects().add({kInputPolarity8, 0, ObjectType::kU8, ObjectAccess::kConst, Mapping::kNo, 1});
  objects().add({kInputPolarity8, 1, ObjectType::kU8, ObjectAccess::kReadWrite, Mapping::kNo, 0});
}

}  // namespace godobject::sim
