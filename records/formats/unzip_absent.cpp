#include "records/formats/detail/packed_file.hpp"
#include "records/headers/text_file.hpp"

namespace musim::records::detail {

/// Stands in a build without libzip.
NamedBytes unzip(const NamedBytes& packed, std::size_t /*largest*/) {
    BinaryFile(packed.path, {})
        .fail("is a zip file, which this build of musim does not unpack", "unpack it first, or build musim where Debian's libzip-dev is");
}

}  // namespace musim::records::detail
