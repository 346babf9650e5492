#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "records/formats/detail/streams.hpp"

namespace musim::records::detail {

/// Ways to store differences of neighbouring samples in as few bits as they need [SEED manual 2.4, appendix B].
enum class SteimCoding { steim1, steim2 };

/// Samples of `frames`, each of 64 bytes in big-endian order: a word of sixteen 2-bit codes, then words of differences; the first frame
/// holds first and last sample before them. Fails unless there are `count` samples, of which the last is the one that the frames announce.
std::vector<std::int32_t> decode_steim(std::string_view frames, std::size_t count, SteimCoding coding, const FailPiece& fail);

}  // namespace musim::records::detail
