#pragma once
/// \file
/// Executors by name, and executors of your own.
///
///     class MyExecutor : public rs::api::Executor { ... };
///     rs::api::ExecutorTable table;                                  // core, scalar, ...
///     RS_TRY(table.add({"mine", "", make_mine}));
///     auto executor = table.create("mine");
///     auto renderer = rs::api::Renderer::create(object, std::move(*executor));

#include "rayspace/api/result.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/api/types/executor_table.hpp"

namespace rs::api {

using rs::engine::ExecutedView;    ///< \copybrief rs::engine::ExecutedView
using rs::engine::Executor;        ///< \copybrief rs::engine::Executor
using rs::engine::ExecutorEntry;   ///< \copybrief rs::engine::ExecutorEntry
using rs::engine::ExecutorTable;   ///< \copybrief rs::engine::ExecutorTable
using rs::engine::ExecutorTraits;  ///< \copybrief rs::engine::ExecutorTraits
using rs::engine::SlotView;        ///< \copybrief rs::engine::SlotView
using rs::engine::TexelFilter;     ///< \copybrief rs::engine::TexelFilter
using rs::engine::ViewRegisters;   ///< \copybrief rs::engine::ViewRegisters

}  // namespace rs::api
