#pragma once
// Edge-avoiding denoising filter: the discontinuity buffer of interleaved instant radiosity (A. Keller, W. Heidrich,
// "Interleaved Sampling", Eurographics Rendering Workshop 2001; I. Wald et al. 2002). It averages the interleaved
// groups of virtual lights of neighbouring pixels, and the noise of path-traced images.
//
// Weights decrease with the distance from the pixel's tangent plane, with differences of normal and surface colour,
// and with radiance differences relative to the noise: the edge-avoiding wavelets of H. Dammertz et al.
// ("Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", HPG 2010) with variance-guided
// weights (C. Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017). Radiance is divided by the surface
// colour before filtering and multiplied afterwards. As samples are added the variance and thus the smoothing
// decrease, so filtered images converge to the unfiltered mean.

#include "capture/tracer/image/accumulation.hpp"

namespace rs::capture {

// Radius of the filter's support along x and y.
inline constexpr int kFilterRadius_px = 40;

/// Filters Accumulation::mean() where the accumulation has guides. The result does not depend on the thread count.
Image<RgbaF> filtered_mean(const Accumulation& accumulation);
/// Filters only `part`, with the same result as for the whole image. with_filter_margin(part) must have samples.
Image<RgbaF> filtered_mean(const Accumulation& accumulation, const PixelRectangle& part);
/// `part` enlarged by the filter's support.
PixelRectangle with_filter_margin(const PixelRectangle& part);

}  // namespace rs::capture
