#pragma once
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// OpenEXR files as other programs write them, by OpenEXR itself.
struct ExrContent {
    struct Channel {
        Imf::PixelType type = Imf::FLOAT;
        std::function<double(int x, int y)> value;  ///< of a pixel of the plane in which the windows lie
    };

    Imath::Box2i display, data;
    std::map<std::string, Channel> channels;
    std::string part = "";
    Imf::Compression compression = Imf::NO_COMPRESSION;
    Imf::LineOrder order = Imf::INCREASING_Y;
    std::function<void(Imf::Header&)> change = [](Imf::Header&) {};

    ExrContent(int width, int height) : display({0, 0}, {width - 1, height - 1}), data(display) {}

    void add(const std::string& name, double value, Imf::PixelType type = Imf::FLOAT) {
        channels[name] = {type, [value](int, int) { return value; }};
    }
    void add(const std::string& name, std::function<double(int, int)> value, Imf::PixelType type = Imf::FLOAT) {
        channels[name] = {type, std::move(value)};
    }
    /// One constant of each letter: "RGB" with three values.
    void add(const std::string& prefix, const std::string& letters, std::vector<double> values,
             Imf::PixelType type = Imf::FLOAT) {
        for (size_t i = 0; i < letters.size(); ++i) add(prefix + letters[i], values[i], type);
    }

    Imf::Header header() const {
        Imf::Header header(display, data, 1, {0, 0}, 1, order, compression);
        for (const auto& [name, channel] : channels) header.channels().insert(name, Imf::Channel(channel.type));
        if (!part.empty()) header.setName(part), header.setType(Imf::SCANLINEIMAGE);
        change(header);
        return header;
    }

    /// The values of the data window; `storage` outlives the frame buffer.
    Imf::FrameBuffer frame(std::vector<std::vector<char>>& storage) const {
        const size_t width = size_t(data.max.x - data.min.x + 1), rows = size_t(data.max.y - data.min.y + 1);
        Imf::FrameBuffer frame;
        for (const auto& [name, channel] : channels) {
            const size_t bytes = channel.type == Imf::HALF ? 2 : 4;
            std::vector<char>& plane = storage.emplace_back(width * rows * bytes);
            for (size_t i = 0; i < width * rows; ++i) {
                const double value = channel.value(data.min.x + int(i % width), data.min.y + int(i / width));
                char* place = plane.data() + i * bytes;
                if (channel.type == Imf::HALF) *reinterpret_cast<half*>(place) = half(float(value));
                if (channel.type == Imf::FLOAT) *reinterpret_cast<float*>(place) = float(value);
                if (channel.type == Imf::UINT) *reinterpret_cast<uint32_t*>(place) = uint32_t(value);
            }
            char* origin = plane.data() - (ptrdiff_t(data.min.y) * ptrdiff_t(width) + data.min.x) * ptrdiff_t(bytes);
            frame.insert(name, Imf::Slice(channel.type, origin, bytes, bytes * width));
        }
        return frame;
    }

    void write(const std::filesystem::path& file) const {
        std::vector<std::vector<char>> storage;
        Imf::OutputFile out(file.c_str(), header());
        out.setFrameBuffer(frame(storage));
        out.writePixels(data.max.y - data.min.y + 1);
    }

    void write_tiled(const std::filesystem::path& file, unsigned tile, Imf::LevelMode levels) const {
        std::vector<std::vector<char>> storage;
        Imf::Header tiled = header();
        tiled.setTileDescription(Imf::TileDescription(tile, tile, levels));
        Imf::TiledOutputFile out(file.c_str(), tiled);
        out.setFrameBuffer(frame(storage));
        for (int ly = 0; ly < out.numYLevels(); ++ly)
            for (int lx = 0; lx < out.numXLevels(); ++lx)
                if (out.isValidLevel(lx, ly))  // smaller levels hold what lies in their window, which nobody reads
                    out.writeTiles(0, out.numXTiles(lx) - 1, 0, out.numYTiles(ly) - 1, lx, ly);
    }
};

inline void write_parts(const std::filesystem::path& file, const std::vector<ExrContent>& parts) {
    std::vector<Imf::Header> headers;
    for (const ExrContent& part : parts) headers.push_back(part.header());
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), int(headers.size()));
    for (size_t i = 0; i < parts.size(); ++i) {
        std::vector<std::vector<char>> storage;
        Imf::OutputPart part(out, int(i));
        part.setFrameBuffer(parts[i].frame(storage));
        part.writePixels(parts[i].data.max.y - parts[i].data.min.y + 1);
    }
}
