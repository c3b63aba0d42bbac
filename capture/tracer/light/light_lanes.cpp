// The part of LightSet that lights sixteen surfaces at a time.
#include "capture/tracer/packets/light_lanes.hpp"

#include "capture/tracer/light/light_set.hpp"
#include "rayspace/light/directions.hpp"

namespace rs::capture {

void set_lane(std::size_t lane, const LightSample& sample, LightLanes& arrives) {
    arrives.lit[lane] = -1;
    arrives.direction.set(lane, sample.direction);
    arrives.distance[lane] = sample.distance;
    arrives.radiance.set(lane, sample.radiance);
    arrives.pdf[lane] = sample.pdf;
    arrives.delta = sample.delta;
}

bool LightSet::middle(std::size_t number, const SurfaceLanes& surfaces, const MaskLanes& wanted,
                      LightLanes& arrives) const {
    const Lanes3& places = surfaces.near_start;
    MaskLanes asked = wanted;
    if (number < sources_.size()) {
        const Source& source = sources_[number];
        switch (source.kind) {
            case SourceKind::environment:
            case SourceKind::emitters:
                return false;
            case SourceKind::distant: {
                // From the same direction everywhere.
                const auto light = sample_light(lights_[source.index], glm::vec3(0.0F), 1.0F);
                if (!light) return false;
                light_from_afar(light->direction, light->radiance, wanted, arrives);
                return true;
            }
            case SourceKind::local:
                if (model_of(lights_[source.index]).is_even()) {
                    return light_from_point(points_[source.index], places, wanted, arrives);
                }
                if (!reach_of_point(points_[source.index], surfaces, wanted, asked)) return false;
                break;
            case SourceKind::area: {
                const Area& area = areas_[source.index];
                return light_from_area({area.middle, area.normal, area.radiance, area.area, source.power}, places,
                                       wanted, arrives);
            }
        }
    }
    arrives.lit = {};
    bool some = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (asked[lane] == 0) continue;
        const auto light = middle(number, places.at(lane));
        if (!light) continue;
        set_lane(lane, *light, arrives);
        some = true;
    }
    return some;
}

}  // namespace rs::capture
