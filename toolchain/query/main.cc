#include <string>

#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/query/query_points.h"

namespace {

constexpr const char* kFooter = R"(
Example:
  godobject-query teapot.scene points.csv -o distances.csv

POINTS.csv holds rows x,y,z in the still mesh's frame, in metres. OUT.csv gets x,y,z,distance,nx,ny,nz,known:
known = 1 within the stored band; n is the outward normal. known = 0 beyond the band: distance is plus or minus the
band, n is 0. If the moving body is a ball, the band lies around the surface at the ball's radius; beyond it, distance
is the radius plus or minus the band.

Exit codes: 0 done, 64 usage, 65 bad image or row, 66 an input is missing or cannot be read, 74 cannot write,
77 no permission to write.)";

}  // namespace

int main(int argc, char** argv) {
  using namespace godobject;
  CLI::App app{"Looks up distances in a compiled scene.", "godobject-query"};
  std::string scene;
  std::string points;
  std::string output;
  app.add_option("X.scene", scene, "scene image, made by godobject-scenec")->required()->type_name("");
  app.add_option("POINTS.csv", points, "points to look up")->required()->type_name("");
  app.add_option("-o,--output", output, "distances to write")->required()->type_name("OUT.csv");
  app.footer(kFooter);
  return command::run(app, argc, argv, [&] {
    files::output_target(output);  // refused before anything is read
    const files::SceneImage image = files::SceneImage::read(scene);
    command::Progress line;
    query::query_points(image.scene, points, output, [&line](double done) { line.show("points", done); });
  });
}
