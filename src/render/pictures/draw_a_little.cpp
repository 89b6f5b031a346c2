#include <mobb/clip.h>
#include <mobb/fit.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/draw_a_little.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <scene/view_state.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mobbscope {

void draw_a_little(Renderer& renderer) {
    Scene scene;
    const std::vector<mobb::Disk> disks(8, {0, 0, 0.4});
    scene.clips.push_back({"stand", std::nullopt, {}, std::make_shared<const mobb::Clip>(0.1, disks)});
    scene.agents.push_back({"A", 0, {}, std::nullopt});
    PictureOptions options;
    options.size = {160, 120};
    const DrawList list = build_draw_list(FittedScene(std::move(scene), mobb::FitOptions{}), {}, options);
    renderer.draw(list);
    renderer.draw_ids(list);
}

}  // namespace mobbscope
