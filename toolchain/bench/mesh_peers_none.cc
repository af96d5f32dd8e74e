#include "toolchain/bench/mesh_peers.h"

namespace godobject::bench {

MeshPeers mesh_peers(const scene_compiler::TriangleMesh&, const scene_compiler::TriangleMesh&) {
  const std::string cure = "install libfcl-dev and configure again";
  return {.peers = {}, .missing = {{"FCL collide", cure}, {"FCL distance", cure}}};
}

}  // namespace godobject::bench
