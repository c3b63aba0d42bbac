// Implementation of VideoReader (video_reader.hpp) with FFmpeg, part of librayspace_image_io.so.
#include "rayspace/base/conventions.hpp"
#include "rayspace/image_io/image_backend.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/mathematics.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace rs::image_io {
namespace {

// Containers that hold their own data. Playlists (HLS, DASH, concat) and image sequences would open other files.
constexpr const char* kContainers =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,mpegvideo,ogg,flv,asf,mxf,h264,hevc,m4v";
constexpr int kThreads = 4;  // frame threads; each needs the memory of one frame
constexpr int kProbeBytes = 8 << 20;

struct DecoderDeleter {
    void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
    void operator()(std::uint8_t* pixels) const { av_free(pixels); }
};
template <class T>
using DecoderOwned = std::unique_ptr<T, DecoderDeleter>;

std::string describe_error(int failure) {
    char text[AV_ERROR_MAX_STRING_SIZE];
    av_make_error_string(text, sizeof text, failure);
    return text;
}

// Converts a display matrix (libavutil/display.h) to ImageInfo::orientation; 1 if it is no rotation by a multiple of
// 90 degrees.
int orientation_from(const std::int32_t* matrix) {
    const auto sign = [](std::int32_t value) { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); };
    // Shown x = a x + c y, shown y = b x + d y.
    const int a = sign(matrix[0]), b = sign(matrix[1]), c = sign(matrix[3]), d = sign(matrix[4]);
    const bool is_upright = b == 0 && c == 0 && a != 0 && d != 0;
    const bool is_on_side = a == 0 && d == 0 && b != 0 && c != 0;
    if (is_upright) return a > 0 ? (d > 0 ? 1 : 4) : (d > 0 ? 2 : 3);
    if (is_on_side) return b > 0 ? (c > 0 ? 5 : 6) : (c > 0 ? 8 : 7);
    return 1;
}

// Files may state codes that the enumeration does not have, which must not be read as one.
template <class Enumeration>
int code_of(const Enumeration& value) {
    static_assert(sizeof(Enumeration) == sizeof(int));
    int code = 0;
    std::memcpy(&code, &value, sizeof code);
    return code;
}

int color_matrix(const AVFrame& frame) {
    const int code = code_of(frame.colorspace);
    const bool is_known = code >= 0 && code < AVCOL_SPC_NB;
    if (is_known && code != AVCOL_SPC_UNSPECIFIED && code != AVCOL_SPC_RGB) return code;
    constexpr int kFirstHdHeight = 720;
    return frame.height >= kFirstHdHeight ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
}

class LibavDecoder final : public VideoDecoder {
public:
    explicit LibavDecoder(std::string path) : path_(std::move(path)) {}

    Status open() {
        RS_TRY(open_container());
        const AVCodec* codec = nullptr;
        const int index = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
        if (index == AVERROR_DECODER_NOT_FOUND) return Error{path_ + missing_decoder_message()};
        if (index < 0)
            return Error{path_ + ": has no video stream; use a video of the turning object, or a folder of photos"};
        stream_ = format_->streams[index];
        for (unsigned i = 0; i < format_->nb_streams; ++i) {
            if (static_cast<int>(i) != index) format_->streams[i]->discard = AVDISCARD_ALL;
        }
        RS_TRY(read_stream_info());
        return open_codec(*codec);
    }

    [[nodiscard]] const VideoInfo& info() const override { return info_; }
    [[nodiscard]] int damaged_frames() const override { return damaged_; }

    Result<bool> read(Image<Rgba8>& frame) override {
        while (!is_finished_) {
            const int got = avcodec_receive_frame(codec_.get(), frame_.get());
            if (got == 0) {
                if (!is_intact()) {
                    ++damaged_;
                    continue;
                }
                last_pts_ = std::max(last_pts_, frame_->best_effort_timestamp);
                ++decoded_;
                RS_TRY(convert(frame));
                return true;
            }
            if (got == AVERROR_EOF) {
                is_finished_ = true;
                RS_TRY(check_end());
            } else if (got != AVERROR(EAGAIN)) {
                ++damaged_;
                if (damaged_ > kMaxFailures) return Error{path_ + damage_message()};
            } else
                RS_TRY(send_packet());
        }
        return false;
    }

private:
    static constexpr int kMaxFailures = 10000;  // a decoder may fail without consuming input

    [[nodiscard]] std::string missing_decoder_message() const {
        std::string codec = "its codec";
        for (unsigned i = 0; i < format_->nb_streams; ++i) {
            const AVCodecParameters& parameters = *format_->streams[i]->codecpar;
            if (parameters.codec_type == AVMEDIA_TYPE_VIDEO) codec = avcodec_get_name(parameters.codec_id);
        }
        return ": the installed FFmpeg has no decoder for " + codec + "; convert the video to H.264";
    }
    [[nodiscard]] std::string damage_message() const {
        return ": is damaged (" + std::to_string(damaged_) + " frames cannot be decoded); copy the video again";
    }

    Status open_container() {
        AVFormatContext* format = avformat_alloc_context();
        if (format == nullptr) return Error{path_ + ": not enough memory to open a video"};
        format->format_whitelist = av_strdup(kContainers);
        format->protocol_whitelist = av_strdup("file");
        format->probesize = kProbeBytes;
        // Frees the context on failure.
        const int failure = avformat_open_input(&format, ("file:" + path_).c_str(), nullptr, nullptr);
        if (failure < 0) {
            return Error{path_ + ": cannot be read as a video (" + describe_error(failure) +
                         "); use a complete video file, or a folder of photos"};
        }
        format_.reset(format);
        if (const int found = avformat_find_stream_info(format, nullptr); found < 0) {
            return Error{path_ + ": is damaged or cut short (" + describe_error(found) + "); copy the video again"};
        }
        return {};
    }

    Status read_stream_info() {
        const AVCodecParameters& stored = *stream_->codecpar;
        const AVRational aspect = av_guess_sample_aspect_ratio(format_.get(), stream_, nullptr);
        info_.height = stored.height;
        info_.width = stored.width;
        if (aspect.num > 0 && aspect.den > 0) {
            const double width = std::round(stored.width * av_q2d(aspect));
            info_.width = static_cast<int>(std::clamp(width, 0.0, 2.0 * kMaxImageSide_px));
        }
        const auto is_bad = [](int side) { return side < 1 || side > kMaxImageSide_px; };
        if (is_bad(stored.width) || is_bad(info_.width) || is_bad(info_.height)) {
            return Error{path_ + ": has frames of " + std::to_string(stored.width) + "x" +
                         std::to_string(stored.height) + " pixels; each side must be 1.." +
                         std::to_string(kMaxImageSide_px)};
        }
        std::size_t bytes = 0;
        const std::uint8_t* const matrix = av_stream_get_side_data(stream_, AV_PKT_DATA_DISPLAYMATRIX, &bytes);
        if (matrix != nullptr && bytes >= 9 * sizeof(std::int32_t)) {
            std::int32_t values[9];
            std::memcpy(values, matrix, sizeof values);
            info_.orientation = orientation_from(values);
        }
        if (stream_->avg_frame_rate.num > 0 && stream_->avg_frame_rate.den > 0) {
            info_.frames_per_second = av_q2d(stream_->avg_frame_rate);
        }
        info_.frame_estimate = std::max<std::int64_t>(stream_->nb_frames, 0);
        if (info_.frame_estimate == 0 && header_duration_s() > 0) {
            const double estimate = header_duration_s() * info_.frames_per_second;
            info_.frame_estimate = estimate < 1e9 ? std::llround(estimate) : 0;
        }
        info_.is_hdr =
            code_of(stored.color_trc) == AVCOL_TRC_SMPTE2084 || code_of(stored.color_trc) == AVCOL_TRC_ARIB_STD_B67;
        return {};
    }

    Status open_codec(const AVCodec& codec) {
        codec_.reset(avcodec_alloc_context3(&codec));
        frame_.reset(av_frame_alloc());
        packet_.reset(av_packet_alloc());
        if (!codec_ || !frame_ || !packet_) return Error{path_ + ": not enough memory to decode a video"};
        if (const int failure = avcodec_parameters_to_context(codec_.get(), stream_->codecpar); failure < 0) {
            return Error{path_ + ": cannot be decoded (" + describe_error(failure) + ")"};
        }
        codec_->thread_count = kThreads;
        codec_->max_pixels = std::int64_t{kMaxImageSide_px} * kMaxImageSide_px;
        codec_->pkt_timebase = stream_->time_base;
        if (const int failure = avcodec_open2(codec_.get(), &codec, nullptr); failure < 0) {
            return Error{path_ + ": cannot be decoded (" + describe_error(failure) + "); convert the video to H.264"};
        }
        return {};
    }

    // Sends the next packet of the stream, or the end of the file, to the decoder.
    Status send_packet() {
        if (is_drained_) return {};
        const int got = av_read_frame(format_.get(), packet_.get());
        if (got < 0) {
            is_drained_ = true;
            if (got != AVERROR_EOF) ++damaged_;
            avcodec_send_packet(codec_.get(), nullptr);
            return {};
        }
        if (packet_->stream_index == stream_->index) {
            const int sent = avcodec_send_packet(codec_.get(), packet_.get());
            if (sent < 0 && sent != AVERROR(EAGAIN)) ++damaged_;
        }
        av_packet_unref(packet_.get());
        if (damaged_ > kMaxFailures) return Error{path_ + damage_message()};
        return {};
    }

    [[nodiscard]] bool is_intact() const {
        return (frame_->flags & AV_FRAME_FLAG_CORRUPT) == 0 && frame_->decode_error_flags == 0;
    }

    [[nodiscard]] double header_duration_s() const {
        if (stream_->duration > 0) return static_cast<double>(stream_->duration) * av_q2d(stream_->time_base);
        const bool is_stated =
            format_->duration > 0 && format_->duration_estimation_method != AVFMT_DURATION_FROM_BITRATE;
        return is_stated ? static_cast<double>(format_->duration) / AV_TIME_BASE : 0;
    }

    [[nodiscard]] Status check_end() const {
        if (decoded_ == 0) {
            return Error{path_ + ": no frame of it can be decoded; copy the video again, or convert it to H.264"};
        }
        constexpr int kTolerated = 3;
        if (damaged_ > std::max<std::int64_t>(kTolerated, decoded_ / 20)) return Error{path_ + damage_message()};
        const double duration_s = header_duration_s();
        if (last_pts_ == std::numeric_limits<std::int64_t>::min() || duration_s <= 0) return {};
        const std::int64_t start = stream_->start_time != AV_NOPTS_VALUE ? stream_->start_time : 0;
        const double end_s = static_cast<double>(last_pts_ - start) * av_q2d(stream_->time_base);
        if (duration_s - end_s <= std::max(1.0, 0.1 * duration_s)) return {};
        return Error{path_ + ": is cut short (" + std::to_string(std::llround(end_s)) + " of " +
                     std::to_string(std::llround(duration_s)) + " seconds are present); copy the video again"};
    }

    Status convert(Image<Rgba8>& to) {
        const AVPixelFormat format = static_cast<AVPixelFormat>(frame_->format);
        if (frame_->width != stream_->codecpar->width || frame_->height != stream_->codecpar->height) {
            return Error{path_ + ": frame " + std::to_string(decoded_) + " is " + std::to_string(frame_->width) + "x" +
                         std::to_string(frame_->height) + ", others are " + std::to_string(stream_->codecpar->width) +
                         "x" + std::to_string(stream_->codecpar->height) + "; cut the video there"};
        }
        scaler_.reset(sws_getCachedContext(
            scaler_.release(), frame_->width, frame_->height, format, info_.width, info_.height, AV_PIX_FMT_RGBA,
            SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr));
        if (!scaler_) {
            const char* const name = av_get_pix_fmt_name(format);
            return Error{path_ + ": frames of the format " + (name != nullptr ? name : "unknown") +
                         " cannot be converted; convert the video to H.264"};
        }
        constexpr int kOne = 1 << 16;
        const bool is_full_range = code_of(frame_->color_range) == AVCOL_RANGE_JPEG;
        sws_setColorspaceDetails(scaler_.get(), sws_getCoefficients(color_matrix(*frame_)), is_full_range ? 1 : 0,
                                 sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, kOne, kOne);
        // swscale may write beyond the end of a row.
        constexpr int kAlign = 64;
        const int stride = (4 * info_.width + 2 * kAlign - 1) / kAlign * kAlign;
        if (!rgba_) {
            const std::size_t rows = static_cast<std::size_t>(info_.height) + 1;
            rgba_.reset(static_cast<std::uint8_t*>(av_malloc(static_cast<std::size_t>(stride) * rows)));
            if (!rgba_) return Error{path_ + ": not enough memory for a frame"};
        }
        std::uint8_t* const planes[4] = {rgba_.get(), nullptr, nullptr, nullptr};
        const int strides[4] = {stride, 0, 0, 0};
        sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, frame_->height, planes, strides);
        if (to.width() != info_.width || to.height() != info_.height) to = Image<Rgba8>(info_.width, info_.height);
        for (int y = 0; y < info_.height; ++y) {
            std::memcpy(to.row(y), rgba_.get() + static_cast<std::ptrdiff_t>(y) * stride,
                        sizeof(Rgba8) * static_cast<std::size_t>(info_.width));
            for (int x = 0; x < info_.width; ++x) to(x, y).a = 255;
        }
        return {};
    }

    std::string path_;
    VideoInfo info_;
    DecoderOwned<AVFormatContext> format_;
    DecoderOwned<AVCodecContext> codec_;
    DecoderOwned<AVFrame> frame_;
    DecoderOwned<AVPacket> packet_;
    DecoderOwned<SwsContext> scaler_;
    DecoderOwned<std::uint8_t> rgba_;
    AVStream* stream_ = nullptr;  // owned by format_
    std::int64_t decoded_ = 0;
    std::int64_t last_pts_ = std::numeric_limits<std::int64_t>::min();
    int damaged_ = 0;
    bool is_drained_ = false;
    bool is_finished_ = false;
};

}  // namespace

Result<std::unique_ptr<VideoDecoder>> read_video(const std::string& path) {
    // Errors are returned; FFmpeg must not write them to stderr as well.
    av_log_set_level(AV_LOG_QUIET);
    auto decoder = std::make_unique<LibavDecoder>(path);
    RS_TRY(decoder->open());
    return std::unique_ptr<VideoDecoder>(std::move(decoder));
}

}  // namespace rs::image_io
