#pragma once
// Fixture of tests that render: each has its own OpenGL context and is skipped without OpenGL. At its end the context
// must have no error and no unreleased object.

#include "compositor/gl/context.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <utility>

namespace rs::test {

class GlTest : public ::testing::Test {
protected:
    void SetUp() override {
        Result<gl::Context> context = gl::Context::create_surfaceless({.debug = true});
        if (!context) GTEST_SKIP() << context.error().message;
        context_.emplace(std::move(*context));
    }
    void TearDown() override {
        if (!context_) return;
        EXPECT_THAT(context_->take_errors(), ::testing::IsEmpty());
        EXPECT_THAT(context_->live_objects(), ::testing::IsEmpty());
    }

    std::optional<gl::Context> context_;
};

}  // namespace rs::test
