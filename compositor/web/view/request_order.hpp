#pragma once
// The order in which a page requests the shape maps and photos of an object whose maps it has, from what its view
// shows: the list of StreamedObject::next_range().

#include "compositor/web/view/object_view.hpp"
#include "rayspace/format/chunk_table.hpp"

#include <vector>

namespace rs::web {

/// Chunks `shap` and PICT, the most wanted first; those that have arrived may be among them. Photos follow those that
/// they are predicted from; as long as these are unknown, they are taken to be the nearest ones of lower levels.
std::vector<object_chunks::ChunkKey> request_order(const ObjectView& shown, const OrbitView& view);

}  // namespace rs::web
