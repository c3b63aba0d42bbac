// Video writer of librayspace_image_io.so, with FFmpeg's libraries. See image_io.hpp for the contracts.
#include "rayspace/image_io/image_backend.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <cerrno>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace rs::image_io {
namespace {

// Rate factor of x264 at which compression is visible only in a side-by-side comparison.
constexpr const char* kRateFactor = "15";
// With x264's default preset, coding an orbit takes longer than rendering it; this preset costs 0.4 dB of 38 and 1 % of
// bits.
constexpr const char* kPreset = "veryfast";

struct Deleter {
    void operator()(AVFormatContext* format) const {
        if (format->pb != nullptr) avio_closep(&format->pb);
        avformat_free_context(format);
    }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
template <class T>
using Owned = std::unique_ptr<T, Deleter>;

std::string text_of(int failure) {
    if (failure == AVERROR(ENOSPC)) return "no space left on device; free some space or write elsewhere";
    char text[AV_ERROR_MAX_STRING_SIZE];
    av_make_error_string(text, sizeof text, failure);
    return text;
}

class LibavEncoder final : public VideoEncoder {
public:
    LibavEncoder(std::string shown, const VideoOptions& options)
        : shown_(std::move(shown)),
          options_(options),
          rgb_(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height) * 3) {}

    Status open(const std::string& path) {
        AVFormatContext* format = nullptr;
        if (avformat_alloc_output_context2(&format, nullptr, nullptr, path.c_str()) < 0) {
            return Error{shown_ + ": is not a video extension; use .mp4"};
        }
        format_.reset(format);
        // H.264 plays everywhere; MPEG-4 is the fallback if FFmpeg was built without an H.264 encoder.
        const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
        if (codec == nullptr) codec = avcodec_find_encoder(AV_CODEC_ID_MPEG4);
        stream_ = codec != nullptr ? avformat_new_stream(format, nullptr) : nullptr;
        codec_.reset(stream_ != nullptr ? avcodec_alloc_context3(codec) : nullptr);
        frame_.reset(av_frame_alloc());
        packet_.reset(av_packet_alloc());
        if (!codec_ || !frame_ || !packet_) return Error{shown_ + ": this FFmpeg has no encoder for H.264 or MPEG-4"};
        describe(*codec);
        if (const int failure = avcodec_open2(codec_.get(), codec, nullptr); failure < 0) return failed(failure);
        if (const int failure = avcodec_parameters_from_context(stream_->codecpar, codec_.get()); failure < 0) {
            return failed(failure);
        }
        stream_->time_base = codec_->time_base;
        RS_TRY(make_frame());
        if (const int failure = avio_open(&format->pb, path.c_str(), AVIO_FLAG_WRITE); failure < 0) {
            return failed(failure);
        }
        const int failure = avformat_write_header(format, nullptr);
        return failure < 0 ? failed(failure) : Status();
    }

    Status add(ConstImageView<Rgba8> frame) override {
        std::uint8_t* to = rgb_.data();
        for (int y = 0; y < frame.height(); ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                const Rgba8 p = over(frame(x, y), options_.backdrop);
                for (const std::uint8_t value : {p.r, p.g, p.b}) *to++ = value;
            }
        }
        if (const int failure = av_frame_make_writable(frame_.get()); failure < 0) return failed(failure);
        const std::uint8_t* const rows[] = {rgb_.data()};
        const int stride[] = {3 * options_.width};
        sws_scale(scaler_.get(), rows, stride, 0, options_.height, frame_->data, frame_->linesize);
        frame_->pts = frames_++;
        return encode(frame_.get());
    }

    Status finish() override {
        if (frames_ == 0) return Error{shown_ + ": a video needs at least one frame"};
        RS_TRY(encode(nullptr));
        if (const int failure = av_write_trailer(format_.get()); failure < 0) return failed(failure);
        const int failure = avio_closep(&format_->pb);  // flushes buffered data to the disk
        return failure < 0 ? failed(failure) : Status();
    }

private:
    [[nodiscard]] Error failed(int failure) const { return Error{shown_ + ": " + text_of(failure)}; }

    void describe(const AVCodec& codec) const {
        codec_->width = options_.width;
        codec_->height = options_.height;
        codec_->framerate = av_d2q(options_.frames_per_second, 1'000'000);
        codec_->time_base = av_inv_q(codec_->framerate);
        codec_->pix_fmt = AV_PIX_FMT_YUV420P;  // supported by every player
        codec_->color_range = AVCOL_RANGE_MPEG;
        codec_->colorspace = AVCOL_SPC_BT709;
        codec_->color_primaries = AVCOL_PRI_BT709;
        codec_->color_trc = AVCOL_TRC_BT709;
        if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        if (codec.id == AV_CODEC_ID_H264) {
            av_opt_set(codec_->priv_data, "crf", kRateFactor, 0);
            av_opt_set(codec_->priv_data, "preset", kPreset, 0);
        } else {
            codec_->flags |= AV_CODEC_FLAG_QSCALE;
            codec_->global_quality = 2 * FF_QP2LAMBDA;
        }
    }

    Status make_frame() {
        frame_->format = codec_->pix_fmt;
        frame_->width = options_.width;
        frame_->height = options_.height;
        frame_->color_range = codec_->color_range;
        frame_->colorspace = codec_->colorspace;
        if (const int failure = av_frame_get_buffer(frame_.get(), 0); failure < 0) return failed(failure);
        scaler_.reset(sws_getContext(options_.width, options_.height, AV_PIX_FMT_RGB24, options_.width, options_.height,
                                     codec_->pix_fmt, SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr,
                                     nullptr, nullptr));
        if (!scaler_) return Error{shown_ + ": FFmpeg cannot convert frames of this size"};
        const int* const of_rgb = sws_getCoefficients(SWS_CS_DEFAULT);
        constexpr int kOne = 1 << 16;
        sws_setColorspaceDetails(scaler_.get(), of_rgb, 1, sws_getCoefficients(SWS_CS_ITU709), 0, 0, kOne, kOne);
        return {};
    }

    // Encodes a frame; null flushes the encoder.
    Status encode(const AVFrame* frame) {
        if (const int failure = avcodec_send_frame(codec_.get(), frame); failure < 0) return failed(failure);
        for (;;) {
            const int got = avcodec_receive_packet(codec_.get(), packet_.get());
            if (got == AVERROR(EAGAIN) || got == AVERROR_EOF) return {};
            if (got < 0) return failed(got);
            packet_->duration = 1;
            av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
            packet_->stream_index = stream_->index;
            if (const int failure = av_interleaved_write_frame(format_.get(), packet_.get()); failure < 0) {
                return failed(failure);
            }
        }
    }

    std::string shown_;
    VideoOptions options_;
    std::vector<std::uint8_t> rgb_;
    Owned<AVFormatContext> format_;
    Owned<AVCodecContext> codec_;
    Owned<AVFrame> frame_;
    Owned<AVPacket> packet_;
    Owned<SwsContext> scaler_;
    AVStream* stream_ = nullptr;  // owned by the format context
    std::int64_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<VideoEncoder>> open_video(const std::string& path, const std::string& shown,
                                                 const VideoOptions& options) {
    // Errors are returned; FFmpeg must not write them to stderr as well.
    av_log_set_level(AV_LOG_QUIET);
    auto encoder = std::make_unique<LibavEncoder>(shown, options);
    RS_TRY(encoder->open(path));
    return std::unique_ptr<VideoEncoder>(std::move(encoder));
}

}  // namespace rs::image_io
