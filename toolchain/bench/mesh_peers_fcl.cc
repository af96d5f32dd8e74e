#include <fcl/fcl.h>

#include "toolchain/bench/mesh_peers.h"

namespace godobject::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const scene_compiler::TriangleMesh& mesh) {
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.vertices.size()));
  std::vector<fcl::Triangle> triangles;
  for (const auto& corners : mesh.triangles) triangles.emplace_back(corners[0], corners[1], corners[2]);
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d transform(const Pose& H_WM) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = H_WM.rotation.toRotationMatrix();
  result.translation() = H_WM.translation;
  return result;
}

}  // namespace

MeshPeers mesh_peers(const scene_compiler::TriangleMesh& still, const scene_compiler::TriangleMesh& moving) {
  constexpr std::size_t kMostContacts = 1000;
  const auto still_model = model_of(still);
  const auto moving_model = model_of(moving);
  MeshPeers found;
  found.peers.push_back({"FCL collide", [=](const Pose& H_WM) {
                           fcl::CollisionRequestd request(kMostContacts, true);
                           fcl::CollisionResultd result;
                           fcl::collide(still_model.get(), fcl::Transform3d::Identity(), moving_model.get(),
                                        transform(H_WM), request, result);
                           return static_cast<double>(result.numContacts());
                         }});
  found.peers.push_back({"FCL distance", [=](const Pose& H_WM) {
                           fcl::DistanceRequestd request(false);
                           fcl::DistanceResultd result;
                           return fcl::distance(still_model.get(), fcl::Transform3d::Identity(), moving_model.get(),
                                                transform(H_WM), request, result);
                         }});
  return found;
}

}  // namespace godobject::bench
