#include "compositor/viewer/drawing/passes/weather_pass.hpp"

#include <algorithm>
#include <limits>

namespace rs::compositor {

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

}  // namespace rs::compositor
