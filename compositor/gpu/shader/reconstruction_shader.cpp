#include "compositor/gpu/shader/reconstruction_shader.hpp"

namespace rs::compositor {
namespace {

const char* version_line(ShaderDialect dialect) {
    return dialect == ShaderDialect::kDesktop ? "#version 450 core\n" : "#version 300 es\n";
}

constexpr const char* kVertex = R"glsl(
void main() {
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
    gl_Position = vec4(4.0 * corner - 1.0, 0.5, 1.0);
}
)glsl";

// Inputs, and the arithmetic of the notation.
constexpr const char* kArithmetic = R"glsl(
precision highp float;
precision highp int;

uniform highp isampler2D setups;        // view_setup.hpp
uniform highp usampler2D cells;         // pairs of cells: depth, shown of a band; depth, shown of the next band
uniform highp usampler2DArray photos;   // [view] R, G, B, A (section 4)
uniform highp isampler2DArray details;  // [view] D (section 7)

uniform ivec2 setup_rows;     // set-up of row j: (j - x) * y; y = 0 in upright views
uniform ivec4 rise_high;      // s0, sx, sy without their lowest eight bits
uniform ivec4 rise_low;       // the lowest eight bits
uniform int b_q16;            // b >> 4
uniform int sampling;         // filter: 0 bilinear, 1 sharp, 2 smooth
uniform ivec2 photo_size;     // W, H
uniform int bands;
uniform int reference_q16;    // H_ref >> 4
uniform int h_low_q16;        // h_low >> 4
uniform int bands_per_unit;   // q12
uniform int depth_step;       // q24
uniform int depth_low;        // s_low, q3
uniform int reference_depth;  // s_ref, q3
uniform int jump;
uniform int thickness;

layout(location = 0) out highp uvec4 colour;
layout(location = 1) out highp int depth_q20;

// The bits of (a * b) >> shift, 3 <= shift <= 31, in 64 bits; `rest`: the bits above them.
int product_shift(int a, int b, int shift, out int rest) {
    int ah = a >> 16;
    int al = a & 0xffff;
    int bh = b >> 16;
    int bl = b & 0xffff;
    uint low = uint(al) * uint(bl);
    int left = ah * bl;
    int right = al * bh;
    int middle = int(low >> 16) + (left & 0xffff) + (right & 0xffff);
    int high = ah * bh + (left >> 16) + (right >> 16) + (middle >> 16);
    low = (uint(middle) << 16) | (low & 0xffffu);
    rest = high >> (shift - 3);
    return (high << (32 - shift)) | int(low >> shift);
}

// hold((a * b) >> shift)
int multiply_shift(int a, int b, int shift) {
    int rest;
    int bits = product_shift(a, b, shift, rest);
    if (rest == 0 || rest == -1) return bits;
    return rest < 0 ? -(1 << 29) : (1 << 29) - 1;
}

// (a * b) >> shift, which is within 32 bits.
int multiply_shift_free(int a, int b, int shift) {
    int rest;
    return product_shift(a, b, shift, rest);
}

// floor(dividend / divisor), dividend >= 0, divisor > 0, the quotient below 2^20.
int divide(int dividend, int divisor) {
    int quotient = int(float(dividend) / float(divisor));
    int rest = dividend - quotient * divisor;
    return rest < 0 ? quotient - 1 : rest >= divisor ? quotient + 1 : quotient;
}

// floor(2^40 / l), 2^17 <= l < 2^29. Remainders wrap around, and are far below 2^31.
int inverse_q20_of(int l) {
    int quotient = int(1099511627776.0 / float(l));
    int rest = -(quotient * l);
    int correction = int(floor(float(rest) / float(l)));
    quotient += correction;
    rest -= correction * l;
    return rest < 0 ? quotient - 1 : rest >= l ? quotient + 1 : quotient;
}
)glsl";

// Section 6.
constexpr const char* kSurfaces = R"glsl(
const int kBothShow = 8;

// The surfaces of section 6 at a band: surface(v), behind(v) and farthest(v). A depth of -1: nothing.
struct Surfaces {
    int depth;
    int lean;
    int behind_depth;
    int behind_lean;
    int deepest;
    bool all_have_one;
};

// Cells around the ray, of two lines each, and its position between them.
struct Columns {
    ivec3 start;  // pair of bands -1 and 0 of column(0, 0) and column(0, 1); pairs from column(0, n) to column(1, n)
    int p_part;
    int line_part;
};

int lean_of(int shown) {
    return shown == 1 ? 0 : shown == 2 ? 2 : 1;
}

// "Between the two lines": x: depth, y: lean. `first`, `second`: depth and shown of a cell.
ivec2 between_lines(ivec2 first, ivec2 second, int part) {
    bool has_first = first.y != 0;
    bool has_second = second.y != 0 && part > 0;
    int apart = second.x - first.x;
    if (has_first && has_second && abs(apart) <= jump) {
        return ivec2(8 * first.x + part * apart, (8 - part) * lean_of(first.y) + part * lean_of(second.y));
    }
    bool takes_second = !has_first || (has_second && part >= 4);
    ivec2 nearest = takes_second ? second : first;
    return has_first || has_second ? ivec2(8 * nearest.x, 8 * lean_of(nearest.y)) : ivec2(-1, kBothShow);
}

// The cells of band and band + 1; those outside of the map are empty.
ivec4 cell_pair(int start, int entry) {
    int n = start + entry;
    return ivec4(texelFetch(cells, ivec2(n & (CELL_WIDTH - 1), n >> CELL_WIDTH_LOG2), 0));
}

// Adds a cell to its group; x: weight, y: depth, z: lean.
void add_cell(ivec2 cell, int part, bool is_far, inout ivec3 near, inout ivec3 far) {
    ivec3 weighted = cell.x >= 0 ? part * ivec3(1, cell.x, cell.y) : ivec3(0);
    near += is_far ? ivec3(0) : weighted;
    far += is_far ? weighted : ivec3(0);
}

// Depth and lean of a group.
ivec2 mean_of(ivec3 group) {
    int weight = max(group.x, 1);
    ivec2 mean = ivec2(divide(group.y + (weight >> 1), weight), divide(group.z + (weight >> 1), weight));
    return group.x == 0 ? ivec2(-1, kBothShow) : mean;
}

int deepest_of(ivec4 pair) {
    return max(pair.x, pair.z);
}

// "Between cells in p and in height".
Surfaces surfaces_at(Columns columns, int band_q12) {
    int from_middle = band_q12 - 2048;
    int band = from_middle >> 12;
    int h_part = (from_middle >> 9) & 7;
    int entry = band < -1 || band >= bands ? bands + 1 : band + 1;
    ivec4 a = cell_pair(columns.start.x, entry);
    ivec4 b = cell_pair(columns.start.y, entry);
    ivec4 c = cell_pair(columns.start.x + columns.start.z, entry);
    ivec4 d = cell_pair(columns.start.y + columns.start.z, entry);
    ivec2 c00 = between_lines(a.xy, b.xy, columns.line_part);
    ivec2 c01 = between_lines(a.zw, b.zw, columns.line_part);
    ivec2 c10 = between_lines(c.xy, d.xy, columns.line_part);
    ivec2 c11 = between_lines(c.zw, d.zw, columns.line_part);

    ivec4 depths = ivec4(c00.x, c01.x, c10.x, c11.x);
    int far_end = max(max(depths.x, depths.y), max(depths.z, depths.w));
    // As unsigned numbers, empty cells are the farthest.
    uvec4 unsigned_depths = uvec4(depths);
    int near_end = int(min(min(unsigned_depths.x, unsigned_depths.y), min(unsigned_depths.z, unsigned_depths.w)));
    int limit = far_end - near_end > 8 * jump ? near_end + far_end : 1 << 20;
    int p1 = columns.p_part;
    int p0 = 8 - p1;
    int h0 = 8 - h_part;
    ivec3 near = ivec3(0);
    ivec3 far = ivec3(0);
    add_cell(c00, p0 * h0, 2 * c00.x > limit, near, far);
    add_cell(c01, p0 * h_part, 2 * c01.x > limit, near, far);
    add_cell(c10, p1 * h0, 2 * c10.x > limit, near, far);
    add_cell(c11, p1 * h_part, 2 * c11.x > limit, near, far);

    Surfaces surfaces;
    bool takes_far = near.x < far.x;
    ivec2 first = mean_of(takes_far ? far : near);
    ivec2 behind = mean_of(takes_far ? ivec3(0) : far);
    surfaces.depth = first.x;
    surfaces.lean = first.y;
    surfaces.behind_depth = behind.x;
    surfaces.behind_lean = behind.y;
    surfaces.deepest = max(max(deepest_of(a), deepest_of(b)), max(deepest_of(c), deepest_of(d)));
    surfaces.all_have_one = a.y * a.w * b.y * b.w * c.y * c.w * d.y * d.w != 0;
    return surfaces;
}

// "Surfaces along the ray": its bands.
struct Ray {
    int rise;     // q24
    int at_foot;  // q12
    int per_d;    // q17
    int size;     // of a step, whole steps of depth
    bool marches;
};

int band_at(Ray ray, int d) {
    int s = depth_low + 8 * min(d, 255);
    int divisor = max(reference_depth + s, (reference_depth + 1) >> 1);
    int effective = clamp(s - divide(s * s, divisor), -4095, 4095);
    return ray.at_foot + ((effective * ray.per_d) >> 8);
}

Ray follow_ray(int rise, int lambda_foot, int inverse_r, int inverse_rho) {
    int h = b_q16 + multiply_shift(lambda_foot, rise, 28);
    int slope = multiply_shift(rise, inverse_r, 24);
    int reference = multiply_shift(h - reference_q16, inverse_rho, 16);
    int drift = multiply_shift(slope - reference, bands_per_unit, 12);
    Ray ray;
    ray.rise = rise;
    ray.at_foot = multiply_shift(h - h_low_q16, bands_per_unit, 16);
    int per_d = clamp(multiply_shift(drift, depth_step, 24), -(1 << 22), 1 << 22);
    ray.per_d = per_d >> 3;
    int steps = min((abs(per_d) >> 11) + 1, 64);
    ray.size = divide(256, steps);
    ray.marches = steps > 1;
    return ray;
}
)glsl";

// Section 6, "The march": its steps. Only steps from `begin` to `end` can meet a surface of the cells around the ray;
// all others are skipped.
constexpr const char* kMarch = R"glsl(
// The steps that begin at multiples of ray.size, begin <= . < end.
struct March {
    int begin;
    int end;
};

// Depth with the effective depth e (q3), estimated: inverse of the formula in band_at.
float depth_at(float e) {
    float reference = float(reference_depth);
    float s = e < -reference ? 0.25 * reference * (1.0 - sqrt(1.0 - 8.0 * e / reference)) : e * reference / (reference - e);
    return clamp((s - float(depth_low)) / 8.0, -1024.0, 1024.0);
}

// depths: nearest, deepest of the cells; their bands: first, last.
March march_steps(Ray ray, ivec2 depths, ivec2 cell_bands) {
    if (!ray.marches || cell_bands.x > cell_bands.y) return March(256, 256);
    // A surface is met where depth <= 8 * (begin + size), and deepest(v) + thickness >= begin.
    int begin = depths.x - ray.size;
    int end = min(depths.y + thickness + 1, 256);
    // The band in the middle of a step is one of first - 1 .. last. These effective depths are off by less than 3 and are
    // widened by 4, estimated depths are off by less than 1 and are widened by 2. At the bounds of effective depths
    // (4095 and the reference viewpoint) steps are not skipped.
    if (ray.per_d != 0) {
        vec2 bounds = vec2(ivec2(cell_bands.x - 1, cell_bands.y + 1) * 4096 + 2048 - ray.at_foot);
        vec2 effective = bounds * 256.0 / float(ray.per_d);
        int middle = ray.size >> 1;
        float least = min(effective.x, effective.y) - 4.0;
        float most = max(effective.x, effective.y) + 4.0;
        if (least > 4100.0 || most < -4100.0) return March(256, 256);
        float bound = min(4080.0, 0.9 * float(reference_depth));
        if (least > -4080.0 && least < bound) begin = max(begin, int(depth_at(least)) - middle - 2);
        float last = most > -4080.0 && most < bound ? depth_at(most) : 255.0;
        // Depths behind the last one count as the last one.
        if (last < 254.0) end = min(end, int(last) - middle + 3);
    }
    return March(ray.size * divide(max(begin, 0), ray.size), end);
}
)glsl";

// Sections 7 and 8.
constexpr const char* kBlend = R"glsl(
// The numbers of section 5 that project a ray into a photo, and those of its camera.
struct Photo {
    int layer;
    ivec4 line;  // L0 q20, L1 q24, Q0 q12, Q1 q12
    ivec4 lens;  // cx q8, cy q8, fl_y q8, height q16
};

// A sample of a photo, or a blend of two.
struct Sum {
    bool exists;  // not outside
    int a;
    ivec3 rgb;
    int detail;
};

const Sum kOutside = Sum(false, 0, ivec3(0), 0);

void add_texel(inout Sum sum, int layer, int column, int row, int weight) {
    ivec4 texel = ivec4(texelFetch(photos, ivec3(column, row, layer), 0));
    int alpha = weight * texel.a;
    sum.a += alpha;
    sum.rgb += alpha * texel.rgb;
}

int detail_at(int layer, int column, int row) {
    return texelFetch(details, ivec3(column, row, layer), 0).r;
}

// Section 7.
Sum sample_photo(Photo photo, int d, int y) {
    int l = photo.line.x + ((d * photo.line.y) >> 7);
    bool is_before = l >= 1 << 17;
    int inverse = inverse_q20_of(max(l, 1 << 17));
    int column = photo.lens.x + multiply_shift_free(photo.line.z + ((d * photo.line.w) >> 3), inverse, 24);
    int m = multiply_shift_free(photo.lens.z, inverse, 16);
    int row = photo.lens.y - multiply_shift(m, y - photo.lens.w, 20);
    bool is_inside = column >= 0 && column < photo_size.x << 8 && row >= 0 && row < photo_size.y << 8;
    if (!is_before || !is_inside) return kOutside;

    int x = (column - 112) >> 5;
    int z = (row - 112) >> 5;
    int fx = x & 7;
    int fz = z & 7;
    int left = max(x >> 3, 0);
    int right = min((x >> 3) + 1, photo_size.x - 1);
    int top = max(z >> 3, 0);
    int bottom = min((z >> 3) + 1, photo_size.y - 1);
    ivec4 weights = ivec4((8 - fx) * (8 - fz), (8 - fx) * fz, fx * (8 - fz), fx * fz);
    Sum sum = Sum(true, 0, ivec3(0), 0);
    add_texel(sum, photo.layer, left, top, weights.x);
    add_texel(sum, photo.layer, left, bottom, weights.y);
    add_texel(sum, photo.layer, right, top, weights.z);
    add_texel(sum, photo.layer, right, bottom, weights.w);
    if (sampling != 0) {
        int e = weights.x * detail_at(photo.layer, left, top) + weights.y * detail_at(photo.layer, left, bottom) +
                weights.z * detail_at(photo.layer, right, top) + weights.w * detail_at(photo.layer, right, bottom);
        int g = sampling == 1 ? fx * (8 - fx) + fz * (8 - fz) : -26;
        sum.detail = (sum.a * ((g * e) >> 6)) >> 6;
    }
    return sum;
}

Sum mix_sums(Sum first, Sum second, int weight) {
    int rest = 256 - weight;
    return Sum(true, first.a * rest + second.a * weight, first.rgb * rest + second.rgb * weight,
               first.detail * rest + second.detail * weight);
}

// Section 8, "What a surface at depth d with a lean shows".
Sum blend_photos(Photo first, Photo second, int weight, int d, int y, int lean) {
    Sum s1 = kOutside;
    Sum s2 = kOutside;
    if (weight < 256) s1 = sample_photo(first, d, y);
    if (weight > 0) s2 = sample_photo(second, d, y);
    int w = lean <= kBothShow ? (weight * lean + 4) >> 3 : weight + (((256 - weight) * (lean - kBothShow) + 4) >> 3);
    if (!s1.exists && !s2.exists) return kOutside;
    if ((s1.exists && s1.a == 0) || (s2.exists && s2.a == 0)) return kOutside;
    if (!s2.exists) w = 0;
    if (!s1.exists) w = 256;
    return mix_sums(s1, s2, w);
}

// Section 8, "The output".
ivec4 resolve(Sum sum) {
    int alpha = (sum.a + (1 << 13)) >> 14;
    if (alpha == 0) return ivec4(0);
    ivec3 c = clamp(sum.rgb + sum.detail, ivec3(0), ivec3(255 * sum.a)) + (sum.a >> 1);
    return ivec4(divide(c.r, sum.a), divide(c.g, sum.a), divide(c.b, sum.a), alpha);
}

// A pixel and its lambda.
struct Shown {
    ivec4 rgba;
    int lambda;
};

const int kCoveringAlpha = 230;

// Section 8, "Over".
Shown blend_over(Shown nearer, Shown farther) {
    if (nearer.rgba.a == 0) return farther;
    if (farther.rgba.a < kCoveringAlpha) return nearer;
    int w = nearer.rgba.a + (nearer.rgba.a >> 7);
    ivec4 over = ivec4(nearer.rgba.rgb, 255);
    return Shown((over * w + farther.rgba * (256 - w) + 128) >> 8,
                 nearer.rgba.a < 128 ? farther.lambda : nearer.lambda);
}
)glsl";

constexpr const char* kMain = R"glsl(
ivec4 setup_texel(ivec2 at, int number) {
    return texelFetch(setups, ivec2(at.x, at.y + number), 0);
}

// Sections 3 and 4: the set-up has the row of the photo at view row 0 and its step, modulo 2^32, and the view rows that
// show the photo.
Shown plane_pixel(ivec2 at, ivec4 head, int j) {
    ivec4 place = setup_texel(at, 1);  // layer, column, first view row, end of the view rows
    if (j < place.z || j >= place.w) return Shown(ivec4(0), 0);
    int row = (head.y + j * head.z) >> 16;
    return Shown(ivec4(texelFetch(photos, ivec3(place.y, row, place.x), 0)), head.w);
}

// Sections 6 to 8.
Shown shape_pixel(ivec2 at, ivec4 head, ivec2 pixel) {
    int weight = (head.x >> 2) & 511;
    int foot_d = (head.x >> 17) & 2047;
    ivec4 view = setup_texel(at, 1);  // lambda0 q20, lambda1 q21, layers of the photos, depths of the cells
    ivec4 around = setup_texel(at, 2);
    Columns columns = Columns(around.xyz, (head.x >> 11) & 7, (head.x >> 14) & 7);
    Photo first = Photo(view.z & 0xffff, setup_texel(at, 3), setup_texel(at, 4));
    Photo second = Photo((view.z >> 16) & 0xffff, setup_texel(at, 5), setup_texel(at, 6));
    bool has_shape = (head.x & 3) == 3;
    bool is_alone = weight == 0 || weight == 256;  // so is a ray without a shape

    int rise = rise_high.x + pixel.x * rise_high.y + pixel.y * rise_high.z +
               ((rise_low.x + pixel.x * rise_low.y + pixel.y * rise_low.z) >> 8);
    Ray ray = follow_ray(rise, head.y, head.z, head.w);

    Shown nearer = Shown(ivec4(0), 0);
    Surfaces last = Surfaces(-1, kBothShow, -1, kBothShow, 0, false);
    bool is_at_end = false;
    March march = march_steps(ray, ivec2(view.w & 255, view.w >> 8), ivec2(around.w & 0xffff, (around.w >> 16) & 0xffff));
    if (!has_shape) march.begin = march.end;
    for (;;) {
        int d = -1;
        int lean = kBothShow;
        while (march.begin < march.end && d < 0) {
            int begin = march.begin;
            march.begin += ray.size;
            Surfaces here = surfaces_at(columns, band_at(ray, begin + (ray.size >> 1)));
            if (here.depth < 0 || here.depth > 8 * march.begin || here.deepest + thickness < begin) continue;
            d = max(here.depth, 8 * begin);
            lean = here.lean;
        }
        if (d < 0 && !is_at_end) {
            is_at_end = true;
            if (has_shape) {
                last = surfaces_at(columns, ray.at_foot);
                Surfaces there = surfaces_at(columns, band_at(ray, last.depth >> 3));
                if (last.depth >= 0 && there.depth >= 0) last = there;
            }
            d = last.depth;
            lean = last.lean;
        } else if (d < 0 && last.behind_depth >= 0) {
            d = last.behind_depth;
            lean = last.behind_lean;
            last.behind_depth = -1;
        } else if (d < 0 && last.all_have_one) {
            d = 8 * last.deepest;
            last.all_have_one = false;
        }
        if (d < 0 && is_alone) d = foot_d;
        if (d < 0) break;

        Shown shown;
        shown.lambda = view.x + ((d * view.y) >> 4);
        int y = b_q16 + multiply_shift_free(shown.lambda, ray.rise, 28);
        Sum sum = kOutside;
        if (shown.lambda > 0) sum = blend_photos(first, second, weight, d, y, lean);
        if (sum.a != 0) {
            shown.rgba = resolve(sum);
            nearer = blend_over(nearer, shown);
            if (!is_at_end || shown.rgba.a >= kCoveringAlpha) break;
        }
        if (is_alone) break;
    }
    return nearer;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 at = ivec2(pixel.x, (pixel.y - setup_rows.x) * setup_rows.y);
    ivec4 head = setup_texel(at, 0);
    int kind = head.x & 3;
    Shown shown = Shown(ivec4(0), 0);
    if (kind == 1) shown = plane_pixel(at, head, pixel.y);
    if (kind >= 2) shown = shape_pixel(at, head, pixel);
    colour = uvec4(shown.rgba);
    depth_q20 = shown.rgba.a > 0 ? shown.lambda : 0;
}
)glsl";

}  // namespace

std::string reconstruction_vertex_shader(ShaderDialect dialect) {
    return std::string(version_line(dialect)) + kVertex;
}

std::string reconstruction_fragment_shader(ShaderDialect dialect) {
    const std::string constants = "#define CELL_WIDTH_LOG2 " + std::to_string(kCellTextureWidthLog2) +
                                  "\n#define CELL_WIDTH (1 << CELL_WIDTH_LOG2)\n";
    return version_line(dialect) + constants + kArithmetic + kSurfaces + kMarch + kBlend + kMain;
}

}  // namespace rs::compositor
