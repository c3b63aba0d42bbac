#pragma once
// The GPU as an executor (rayspace/api/types/executor.hpp): `gpu` of --executor. Renders every view that the software
// core renders, to the same bits. Views that may be deferred are left to the caller's OpenGL context as
// DeferredGpuView (gpu_renderer.hpp); others are drawn in an OpenGL 4.5 context of the executor and read back.

#include "rayspace/api/types/executor_table.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <memory>

namespace rs::compositor {

struct GpuExecutorOptions {
    /// Limit for the textures in each context (GpuRendererOptions::memory_bytes). Objects are loaded as long as the
    /// cells of their shape maps and two of their photos fit.
    std::int64_t memory_bytes = std::int64_t{2} << 30;
};

/// Opens a surfaceless context on a thread of the executor, which makes all of its OpenGL calls. Fails without
/// OpenGL 4.5.
Result<std::unique_ptr<engine::Executor>> create_gpu_executor(const GpuExecutorOptions& options = {});

/// The executors of the library and `gpu`.
engine::ExecutorTable executors_with_gpu();

}  // namespace rs::compositor
