#include "records/formats/detail/steim.hpp"

#include <fmt/format.h>

namespace musim::records::detail {
namespace {

constexpr std::size_t kFrameBytes = 64;
constexpr std::size_t kWords = 16;  // of a frame

/// Differences in one word: how many, and the bits of each; they fill the low end of the word, the first one highest.
struct Packing {
    unsigned count = 0;
    unsigned bits = 0;
};

// codes of the frame's first word; Steim-2 has a second one in the two highest bits of the word itself. No bits: not a code
Packing packing_of(unsigned code, std::uint32_t word, SteimCoding coding) {
    if (code == 1) return {4, 8};
    if (coding == SteimCoding::steim1) return code == 2 ? Packing{2, 16} : Packing{1, 32};
    constexpr Packing kSecond[2][4] = {{{}, {1, 30}, {2, 15}, {3, 10}}, {{5, 6}, {6, 5}, {7, 4}, {}}};
    return kSecond[code - 2][word >> 30U];
}

// difference `i` of a word, sign extended
std::uint32_t difference(std::uint32_t word, const Packing& packing, unsigned i) {
    const unsigned above = 32U - packing.bits * (packing.count - i);  // bits of the word above it
    const auto shifted = static_cast<std::int32_t>(word << above);
    return static_cast<std::uint32_t>(shifted >> (32U - packing.bits));
}

}  // namespace

std::vector<std::int32_t> decode_steim(std::string_view frames, std::size_t count, SteimCoding coding, const FailPiece& fail) {
    std::vector<std::int32_t> samples;
    std::uint32_t sample = 0;  // sums wrap around as those of the writer do
    std::uint32_t last = 0;
    for (std::size_t frame = 0; (frame + 1) * kFrameBytes <= frames.size() && samples.size() < count; ++frame) {
        const auto word_at = [&](std::size_t i) { return number_at<std::uint32_t>(frames, frame * kFrameBytes + 4 * i, std::endian::big); };
        const std::uint32_t codes = word_at(0);
        if (frame == 0) {
            sample = word_at(1);
            last = word_at(2);
        }
        for (std::size_t i = frame == 0 ? 3 : 1; i < kWords && samples.size() < count; ++i) {
            const unsigned code = codes >> (2U * (kWords - 1 - i)) & 3U;
            if (code == 0) continue;
            const std::uint32_t word = word_at(i);
            const Packing packing = packing_of(code, word, coding);
            if (packing.bits == 0)
                fail(fmt::format("word {} of frame {} has no valid code (damaged)", i + 1, frame + 1), "fetch the record again");
            for (unsigned k = 0; k < packing.count && samples.size() < count; ++k) {
                // the first difference leads from the record before
                if (!samples.empty()) sample += difference(word, packing, k);
                samples.push_back(static_cast<std::int32_t>(sample));
            }
        }
    }
    if (samples.size() < count) fail(fmt::format("{} samples decoded (header says {})", samples.size(), count), "fetch the record again");
    if (sample != last) {
        fail(fmt::format("last sample is {} (its frames announce {}; damaged)", static_cast<std::int32_t>(sample),
                         static_cast<std::int32_t>(last)),
             "fetch the record again");
    }
    return samples;
}

}  // namespace musim::records::detail
