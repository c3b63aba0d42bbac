#include "compositor/viewer/drawing/passes/blend_passes.hpp"

#include <algorithm>
#include <limits>

namespace rs::compositor {

Status TransparentPass::run(FrameContext& frame) const {
    for (const SurfaceRenderer::Transparent& surface : frame.transparent_surfaces) {
        frame.blended.push_back({surface.distance, false, [&surface, &frame] {
                                     frame.geometry.surfaces().draw_transparent(surface, frame.view, frame.wire_frame);
                                 }});
    }
    std::ranges::stable_sort(frame.blended, [](const BlendedDraw& a, const BlendedDraw& b) {
        if (a.distance != b.distance) return a.distance > b.distance;
        return !a.is_object && b.is_object;
    });
    return {};
}

Result<WeatherPass> WeatherPass::create(const Scene& scene) {
    RS_ASSIGN_OR_RETURN(auto weather, WeatherRenderer::create(scene));
    return WeatherPass(std::move(weather));
}

Status WeatherPass::run(FrameContext& frame) const {
    if (!frame.weather) return {};
    std::vector<BlendedDraw> with_weather;
    double beyond = std::numeric_limits<double>::infinity();
    const auto add_layer = [&](double nearest) {
        if (nearest >= beyond) return;
        with_weather.push_back({nearest, false, [this, &frame, nearest, beyond] {
                                    weather_.draw(*frame.weather, frame.weather_s, frame.view, nearest, beyond);
                                }});
        beyond = nearest;
    };
    for (BlendedDraw& item : frame.blended) {
        if (item.is_object) add_layer(item.distance);
        with_weather.push_back(std::move(item));
    }
    add_layer(0);
    frame.blended = std::move(with_weather);
    return {};
}

Status BlendPass::run(FrameContext& frame) const {
    for (const BlendedDraw& item : frame.blended) item.draw();
    if (frame.target.resolved) frame.target.drawn.resolve_to(*frame.target.resolved);
    frame.statistics.composite_s = frame.clock.lap();
    return {};
}

Status OverlayPass::run(FrameContext& frame) {
    if (!renderer_) {
        Result<HandleRenderer> created = HandleRenderer::create();
        if (!created) return created.error();
        renderer_.emplace(std::move(*created));
    }
    return renderer_->draw(strokes_, frame.view.camera, frame.target.shown(), frame.target.drawn);
}

}  // namespace rs::compositor
