#include <import/nodes/node_scene.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::string_view kSceneMagic = "MOBBFBX1";
constexpr std::string_view kErrorMagic = "MOBBERR1";

class Writer {
  public:
    explicit Writer(std::string_view magic) : bytes_(magic) {}

    void integer(std::int64_t value) { raw(&value, sizeof value); }
    void number(double value) { raw(&value, sizeof value); }
    void text(std::string_view value) {
        integer(static_cast<std::int64_t>(value.size()));
        bytes_ += value;
    }
    /// Of something that is made of doubles.
    template <typename T>
    void doubles(const T& value) {
        raw(&value, sizeof value);
    }
    void numbers(const std::vector<double>& values) {
        integer(static_cast<std::int64_t>(values.size()));
        raw(values.data(), values.size() * sizeof(double));
    }
    std::string take() { return std::move(bytes_); }

  private:
    void raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
    std::string bytes_;
};

void require_packet(bool holds) {
    if (!holds) throw std::length_error("damaged packet");
}

class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    std::int64_t integer() {
        std::int64_t value;
        raw(&value, sizeof value);
        return value;
    }
    /// In [least, most].
    int integer(std::int64_t least, std::int64_t most) {
        const std::int64_t value = integer();
        require_packet(value >= least && value <= most);
        return static_cast<int>(value);
    }
    double number() {
        double value;
        raw(&value, sizeof value);
        require_packet(std::isfinite(value));
        return value;
    }
    /// How many things of at least `size` bytes follow.
    std::size_t count(std::size_t size) {
        const std::int64_t value = integer();
        require_packet(value >= 0 && static_cast<std::size_t>(value) <= rest_.size() / size);
        return static_cast<std::size_t>(value);
    }
    std::string text() {
        const std::size_t size = count(1);
        std::string value(rest_.substr(0, size));
        rest_.remove_prefix(size);
        return value;
    }
    /// Something that is made of doubles, all of them finite.
    template <typename T>
    T doubles() {
        std::array<double, sizeof(T) / sizeof(double)> values;
        for (double& value : values) value = number();
        return std::bit_cast<T>(values);
    }
    Numbers numbers() {
        std::vector<double> values(count(sizeof(double)));
        for (double& value : values) value = number();
        return std::make_shared<const std::vector<double>>(std::move(values));
    }
    bool at_end() const { return rest_.empty(); }

  private:
    void raw(void* data, std::size_t size) {
        require_packet(size <= rest_.size());
        std::memcpy(data, rest_.data(), size);
        rest_.remove_prefix(size);
    }
    std::string_view rest_;
};

Node read_node(Reader& in, int index) {
    Node node;
    node.name = in.text();
    node.parent = in.integer(-1, index - 1);
    node.matrix = in.doubles<Affine>();
    node.rest = in.doubles<TranslationRotationScale>();
    require_packet(std::abs(glm::length(node.rest.rotation) - 1) < 1e-6);
    return node;
}

Channel read_channel(Reader& in, std::size_t nodes) {
    Channel channel;
    channel.node = in.integer(0, static_cast<std::int64_t>(nodes) - 1);
    channel.property = static_cast<NodeProperty>(in.integer(0, 2));
    channel.times = in.numbers();
    channel.values = in.numbers();
    const std::vector<double>& times = *channel.times;
    const std::vector<double>& values = *channel.values;
    const std::size_t width = channel.property == NodeProperty::rotation ? 4 : 3;
    require_packet(!times.empty() && values.size() == times.size() * width);
    require_packet(std::adjacent_find(times.begin(), times.end(), [](double a, double b) { return a >= b; }) ==
                   times.end());
    if (width == 4) {
        for (std::size_t i = 0; i < values.size(); i += 4) {
            require_packet(std::hypot(std::hypot(values[i], values[i + 1]), std::hypot(values[i + 2], values[i + 3])) >
                           1e-6);
        }
    }
    return channel;
}

}  // namespace

std::string pack(const NodeScene& scene) {
    Writer out(kSceneMagic);
    out.number(scene.unit.value_or(0));
    out.integer(static_cast<std::int64_t>(scene.nodes.size()));
    for (const Node& node : scene.nodes) {
        out.text(node.name);
        out.integer(node.parent);
        out.doubles(node.matrix);
        out.doubles(node.rest);
    }
    out.integer(static_cast<std::int64_t>(scene.animations.size()));
    for (const NodeAnimation& animation : scene.animations) {
        out.text(animation.name);
        out.number(animation.times.first);
        out.number(animation.times.last);
        out.integer(static_cast<std::int64_t>(animation.channels.size()));
        for (const Channel& channel : animation.channels) {
            out.integer(channel.node);
            out.integer(static_cast<int>(channel.property));
            out.numbers(*channel.times);
            out.numbers(*channel.values);
        }
    }
    return out.take();
}

std::string pack_error(std::string_view message) {
    Writer out(kErrorMagic);
    out.text(message);
    return out.take();
}

NodeScene unpack(std::string_view packet) {
    require_packet(packet.size() >= kSceneMagic.size());
    Reader in(packet.substr(kSceneMagic.size()));
    if (packet.starts_with(kErrorMagic)) throw std::runtime_error(in.text());
    require_packet(packet.starts_with(kSceneMagic));

    NodeScene scene;
    if (const double unit = in.number(); unit > 0) scene.unit = unit;
    const std::size_t nodes = in.count(1);
    for (std::size_t i = 0; i < nodes; ++i) scene.nodes.push_back(read_node(in, static_cast<int>(i)));
    const std::size_t animations = in.count(1);
    for (std::size_t i = 0; i < animations; ++i) {
        NodeAnimation animation;
        animation.name = in.text();
        const double first = in.number();
        const double last = in.number();
        require_packet(first <= last);
        const std::size_t channels = in.count(1);
        std::vector<Numbers> times;
        for (std::size_t k = 0; k < channels; ++k) {
            animation.channels.push_back(read_channel(in, nodes));
            times.push_back(animation.channels.back().times);
        }
        animation.times = key_times(times);
        animation.times.first = first;
        animation.times.last = last;
        scene.animations.push_back(std::move(animation));
    }
    require_packet(in.at_end());
    return scene;
}

}  // namespace mobbscope
