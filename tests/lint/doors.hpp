#pragma once
// The rooms of the house, and which rooms each may enter.

#include <map>
#include <string>
#include <vector>

namespace rs::lint {

// Room -> the rooms whose headers it may include, besides its own. NAME/* is a room with all rooms inside of it. A file
// belongs to the longest room that it stands in.
inline const std::map<std::string, std::vector<std::string>> kDoors = {
    {"rayspace/base", {}},
    {"rayspace/file", {"rayspace/base"}},
    {"rayspace/image", {"rayspace/base"}},
    {"rayspace/pictures", {"rayspace/base", "rayspace/file", "rayspace/image"}},
    {"rayspace/geometry", {"rayspace/base", "rayspace/file", "rayspace/image", "rayspace/pictures"}},
    {"rayspace/codec/kernels", {"rayspace/base", "rayspace/image"}},
    {"rayspace/codec/code", {"rayspace/base", "rayspace/codec/kernels"}},
    {"rayspace/codec", {"rayspace/base", "rayspace/image", "rayspace/codec/code", "rayspace/codec/kernels"}},
    {"rayspace/codec/board", {"rayspace/base", "rayspace/codec", "rayspace/codec/code", "rayspace/codec/kernels"}},
    {"rayspace/object", {"rayspace/base", "rayspace/image", "rayspace/codec/code"}},
    {"rayspace/codec/stream",
     {"rayspace/base", "rayspace/object", "rayspace/codec", "rayspace/codec/board", "rayspace/codec/code"}},
    {"rayspace/format",
     {"rayspace/base", "rayspace/file", "rayspace/geometry", "rayspace/object", "rayspace/codec",
      "rayspace/codec/stream"}},
    {"rayspace/output", {"rayspace/base", "rayspace/file", "rayspace/image", "rayspace/pictures", "rayspace/geometry"}},
    {"rayspace/page", {"rayspace/base", "rayspace/image", "rayspace/pictures"}},
    {"rayspace/models", {"rayspace/base", "rayspace/file"}},
    {"rayspace/light", {"rayspace/base", "rayspace/file"}},
    {"rayspace/tool", {"rayspace/base", "rayspace/file"}},

    {"capture/opencv", {"rayspace/base", "rayspace/image"}},
    {"capture/calibration/model", {"rayspace/*"}},
    {"capture/calibration/points", {"rayspace/*", "capture/opencv", "capture/calibration/model"}},
    {"capture/calibration/silhouettes", {"rayspace/*", "capture/calibration/model", "capture/calibration/points"}},
    {"capture/calibration/board",
     {"rayspace/*", "capture/opencv", "capture/calibration/model", "capture/calibration/points",
      "capture/calibration/silhouettes"}},
    {"capture/calibration/tracks",
     {"rayspace/*", "capture/calibration/model", "capture/calibration/points", "capture/calibration/silhouettes"}},
    {"capture/calibration/known", {"rayspace/*", "capture/calibration/model"}},
    {"capture/photos/intake", {"rayspace/*"}},
    {"capture/photos/background", {"rayspace/*", "capture/opencv", "capture/photos/intake"}},
    {"capture/photos/foreground",
     {"rayspace/*", "capture/opencv", "capture/photos/intake", "capture/photos/background"}},
    {"capture/photos/masks", {"rayspace/*", "capture/opencv", "capture/photos/intake"}},
    {"capture/photos/segmentation",
     {"rayspace/*", "capture/opencv", "capture/photos/intake", "capture/photos/background", "capture/photos/foreground",
      "capture/photos/masks"}},
    {"capture/photos/rig",
     {"rayspace/*", "capture/opencv", "capture/photos/intake", "capture/photos/segmentation", "capture/calibration/*"}},
    {"capture/photos/report",
     {"rayspace/*", "capture/opencv", "capture/photos/intake", "capture/photos/segmentation", "capture/photos/rig",
      "capture/calibration/*"}},
    {"capture/photos", {"rayspace/*", "capture/photos/*"}},
    {"capture/tracer/scene", {"rayspace/*"}},
    {"capture/tracer/packets", {"rayspace/*", "capture/tracer/scene"}},
    {"capture/tracer/light", {"rayspace/*", "capture/tracer/scene", "capture/tracer/packets"}},
    {"capture/tracer/rays", {"rayspace/*", "capture/tracer/scene", "capture/tracer/packets"}},
    {"capture/tracer/picture", {"rayspace/*", "capture/tracer/light"}},
    {"capture/tracer/integrator",
     {"rayspace/*", "capture/tracer/scene", "capture/tracer/packets", "capture/tracer/light", "capture/tracer/rays",
      "capture/tracer/picture"}},
    // Synthetic photographs follow the model that is calibrated.
    {"capture/tracer/session",
     {"rayspace/*", "capture/tracer/scene", "capture/tracer/rays", "capture/tracer/picture",
      "capture/tracer/integrator", "capture/calibration/model"}},
    {"capture/tools", {"rayspace/*", "capture/*", "datasets-synthetic"}},

    {"datasets-synthetic/shapes", {"rayspace/*", "capture/tracer/scene"}},
    {"datasets-synthetic/objects", {"rayspace/*", "capture/tracer/scene", "datasets-synthetic/shapes"}},
    {"datasets-synthetic/showroom", {"rayspace/*", "capture/tracer/scene", "datasets-synthetic/shapes"}},
    {"datasets-synthetic/street",
     {"rayspace/*", "capture/tracer/scene", "datasets-synthetic/shapes", "datasets-synthetic/showroom"}},
    {"datasets-synthetic/measuring", {"rayspace/*", "capture/tracer/scene", "datasets-synthetic/shapes"}},
    {"datasets-synthetic", {"rayspace/*", "capture/tracer/scene", "datasets-synthetic/objects"}},
    {"datasets-synthetic/tools",
     {"rayspace/*", "datasets-synthetic/measuring", "datasets-synthetic/showroom", "datasets-synthetic/street"}},

    {"encode/set", {"rayspace/*"}},
    {"encode/raymap/silhouettes", {"rayspace/*", "encode/set"}},
    {"encode/raymap", {"rayspace/*", "encode/set", "encode/raymap/silhouettes"}},
    {"encode/codec", {"rayspace/*"}},
    {"encode/codec/board", {"rayspace/*", "encode/codec"}},
    {"encode", {"rayspace/*", "encode/set", "encode/raymap", "encode/codec", "encode/codec/board"}},
    {"encode/report", {"rayspace/*", "encode", "encode/raymap"}},
    // Held-out views are rendered by the engine.
    {"encode/tools", {"rayspace/*", "encode/*", "engine/core/definition", "engine/core/fast"}},

    {"engine/core/definition", {"rayspace/*"}},
    {"engine/core/fast", {"rayspace/*", "engine/core/definition"}},
    {"engine/core/views", {"rayspace/*", "engine/core/definition", "engine/core/fast"}},
    {"engine/driver", {"rayspace/*", "engine/core/definition", "engine/core/fast"}},
    {"engine/conformance", {"rayspace/*", "engine/core/definition"}},
    // The hardware knows the arithmetic, never the renderer that it is compared with.
    {"engine/model/limits", {"rayspace/*"}},
    {"engine/model/clock", {"rayspace/base"}},
    {"engine/model/signals", {"rayspace/*", "engine/core/definition", "engine/model/limits"}},
    {"engine/model/blocks/shared", {"rayspace/*", "engine/model/clock", "engine/model/signals"}},
    {"engine/model/blocks/host", {"rayspace/*", "engine/model/clock", "engine/model/signals"}},
    {"engine/model/blocks/memory", {"rayspace/*", "engine/model/clock", "engine/model/signals"}},
    {"engine/model/blocks/prototype",
     {"rayspace/*", "engine/model/clock", "engine/model/signals", "engine/model/blocks/shared",
      "engine/model/blocks/host"}},
    {"engine/model/blocks/decompression",
     {"rayspace/*", "engine/model/clock", "engine/model/signals", "engine/model/limits", "engine/model/blocks/shared"}},
    {"engine/model/blocks/parallel",
     {"rayspace/*", "engine/core/definition", "engine/model/clock", "engine/model/signals", "engine/model/limits",
      "engine/model/blocks/shared", "engine/model/blocks/prototype"}},
    {"engine/model/blocks/texels",
     {"rayspace/*", "engine/core/definition", "engine/model/clock", "engine/model/signals", "engine/model/limits",
      "engine/model/blocks/shared", "engine/model/blocks/parallel", "engine/model/blocks/decompression"}},
    {"engine/model/layout",
     {"rayspace/*", "engine/model/signals", "engine/model/limits", "engine/model/blocks/shared",
      "engine/model/blocks/memory"}},
    {"engine/model",
     {"rayspace/*", "engine/core/definition", "engine/model/clock", "engine/model/signals", "engine/model/limits",
      "engine/model/layout", "engine/model/blocks/*"}},
    {"engine/model/report", {"rayspace/*", "engine/model"}},
    // The one place that knows every executor.
    {"engine/executors", {"rayspace/*", "engine/core/definition", "engine/core/fast", "engine/model"}},
    {"engine/python", {"rayspace/*", "engine/core/definition", "engine/core/fast", "engine/core/views"}},
    {"engine/tools", {"rayspace/*", "engine/*"}},

    {"compositor/gl", {"rayspace/*"}},
    // What a scene is; then what makes one of a file, and what chooses among the readers.
    {"compositor/scene", {"rayspace/*"}},
    {"compositor/scene/light", {"rayspace/*", "compositor/scene"}},
    {"compositor/scene/model", {"rayspace/*", "compositor/scene"}},
    {"compositor/scene/vrml", {"rayspace/*", "compositor/scene"}},
    {"compositor/scene/vrml1", {"rayspace/*", "compositor/scene/vrml"}},
    {"compositor/scene/x3d", {"rayspace/*", "compositor/scene/vrml"}},
    {"compositor/scene/reader", {"rayspace/*", "compositor/scene/*"}},
    {"compositor/displays", {"rayspace/*", "compositor/scene"}},
    {"compositor/lighting", {"rayspace/*", "compositor/scene", "compositor/scene/light"}},
    {"compositor/traced",
     {"rayspace/*", "compositor/scene", "compositor/scene/light", "compositor/viewer/residency", "capture/tracer/scene",
      "capture/tracer/picture", "capture/tracer/integrator", "engine/core/definition"}},
    {"compositor/viewer/residency", {"rayspace/*", "compositor/scene", "engine/core/fast", "engine/driver"}},
    {"compositor/viewer/views",
     {"rayspace/*", "compositor/scene", "compositor/viewer/residency", "engine/core/definition", "engine/driver"}},
    {"compositor/viewer/shadows",
     {"rayspace/*", "compositor/gl", "compositor/scene", "compositor/viewer/residency", "compositor/viewer/views",
      "engine/core/definition", "engine/core/views"}},
    {"compositor/viewer/drawing",
     {"rayspace/*", "compositor/gl", "compositor/scene", "compositor/scene/light", "compositor/lighting",
      "compositor/viewer/residency", "compositor/viewer/views", "compositor/viewer/shadows", "engine/core/views",
      "engine/driver"}},
    {"compositor/viewer",
     {"rayspace/*", "compositor/scene", "compositor/viewer/residency", "compositor/viewer/drawing", "engine/driver"}},
    {"compositor/sequence",
     {"rayspace/*", "compositor/scene", "compositor/scene/light", "compositor/scene/model", "compositor/scene/reader"}},
    {"compositor/playback",
     {"rayspace/*", "compositor/scene", "compositor/sequence", "compositor/traced", "compositor/viewer",
      "compositor/viewer/residency", "compositor/viewer/views", "compositor/viewer/drawing"}},
    {"compositor/window",
     {"rayspace/*", "compositor/gl", "compositor/scene", "compositor/scene/light", "compositor/lighting",
      "compositor/sequence", "compositor/playback", "compositor/displays", "compositor/traced", "compositor/viewer",
      "compositor/viewer/views", "compositor/viewer/drawing"}},
    // Items, ranks and messages: it knows neither MPI nor what the work is.
    {"compositor/farm/schedule", {"rayspace/base", "rayspace/file"}},
    {"compositor/farm/mpi", {"rayspace/base", "compositor/farm/schedule"}},
    {"compositor/farm/work", {"rayspace/*", "compositor/farm/schedule"}},
    {"compositor/tools", {"rayspace/*", "compositor/*", "engine/core/definition", "engine/executors"}},
};

// The room of a file; empty where it stands in none.
inline std::string room_of(const std::string& path) {
    std::string best;
    for (const auto& [room, may_enter] : kDoors) {
        if (path.rfind(room + "/", 0) == 0 && room.size() > best.size()) best = room;
    }
    return best;
}

// Whether an entry of the table means a room.
inline bool means(const std::string& entry, const std::string& room) {
    if (!entry.ends_with("/*")) return entry == room;
    const std::string whole = entry.substr(0, entry.size() - 2);
    return room == whole || room.rfind(whole + "/", 0) == 0;
}

}  // namespace rs::lint
