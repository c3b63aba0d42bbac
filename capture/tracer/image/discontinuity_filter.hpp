#pragma once
// Brings together what neighbouring pixels have gathered from different lights, but not across edges: the discontinuity
// buffer of interleaved instant radiosity (A. Keller, W. Heidrich, "Interleaved Sampling", Eurographics Rendering
// Workshop 2001; I. Wald et al. 2002).
//
// Paths, whose samples have no such pattern, gain as much: their noise is averaged likewise.
//
// Pixels are averaged as far as their surfaces lie in one plane, face one way and have one colour, and as far as their
// light differs by no more than its noise: the edge-avoiding wavelets of H. Dammertz et al. ("Edge-Avoiding A-Trous
// Wavelet Transform for fast Global Illumination Filtering", HPG 2010) with the noise's variance as a measure
// (C. Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017). Light is divided by the surface's colour
// before and multiplied by it afterwards. As samples are added the noise falls and less is averaged: images go to
// where their mean goes.

#include "capture/tracer/image/accumulation.hpp"

namespace rs::capture {

// How far away a pixel may be that has a part in one's result, along x or y.
inline constexpr int kFilterReach_px = 40;

// As Accumulation::mean(), smoothed where the accumulation has guides. The same bits with any number of threads.
Image<RgbaF> filtered_mean(const Accumulation& accumulation);
// Only this part of the image is smoothed; it has the bits that it has in the whole one. There must be samples as far
// around it as the filter reaches.
Image<RgbaF> filtered_mean(const Accumulation& accumulation, const PixelRectangle& part);
// A part and what the filter takes into account around it.
PixelRectangle within_reach(const PixelRectangle& part);

}  // namespace rs::capture
