#include "toolchain/report/contact_quality/compiled_scene.h"

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"
#include "toolchain/report/contact_quality/body.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {

double shell_thickness(const WorldSettings& settings) { return 2.0 * settings.voxel_size; }

std::filesystem::path still_file(const std::string& name, const std::filesystem::path& folder) {
  return folder / (name + "-still.ply");
}

scene_compiler::CompileReport compile_image(const std::string& name, const SceneText& scene,
                                            const std::filesystem::path& folder) {
  const WorldSettings& q = scene.settings;
  write_ply(scene.still.mesh, still_file(name, folder));
  files::AtomicFile toml(folder / (name + ".toml"));
  toml.write(fmt::format(
      "[still]\nmesh = \"{}\"\nscale = 1.0\nvoxel_size = {}\nsurface = \"{}\"\nthickness = {}\n"
      "[moving]\nmesh = \"{}\"\nscale = 1.0\n{}"
      "[contact]\nedges = {}\nsafety_distance = {}\nmargin = {}\n"
      "[friction]\nstatic = {}\nkinetic = {}\n"
      "[paper]\nrotation_static = {}\nrotation_kinetic = {}\n"
      "[coupling]\nstiffness = {:.1f}\nrotational = {}\n",
      std::filesystem::absolute(still_file(name, folder)).string(), q.voxel_size, scene.still.shell ? "shell" : "solid",
      shell_thickness(q), std::filesystem::absolute(scene.body).string(),
      scene.ball ? std::string("ball = true\n") : fmt::format("points = {}\nlevels = {}\n", scene.points, kBodyLevels),
      scene.edges, q.safety_distance, q.margin, q.friction_static, q.friction_kinetic, q.friction_static,
      q.friction_kinetic, q.stiffness, q.coupling_rotation));
  toml.commit();
  return scene_compiler::compile_scene({.scene_file = folder / (name + ".toml"),
                                        .output = folder / (name + ".scene"),
                                        .only_solver = scene.only_solver,
                                        .progress = {}});
}

files::SceneImage compile(const std::string& name, const SceneText& scene, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / (name + ".scene"))) static_cast<void>(compile_image(name, scene, folder));
  return files::SceneImage::read(folder / (name + ".scene"));
}

}  // namespace godobject::report
