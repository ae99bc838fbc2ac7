// The rows of the components, streamed by blocks of rows of the data.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000
#pragma once

#include <functional>
#include <vector>

#include "compressor/encode/svd/principal_components.h"

namespace paim {

// for_each_encoded_block() works on at most this many blocks at once and then hands them on in
// order.
constexpr uint32_t kMaxBlocksWaiting = 16;

// What a block of rows becomes: the means of its rows, and its rows of the first K components. A
// component has unit RMS over all rows.
struct EncodedRows {
    std::vector<float> mean;                     // [rows of the block]
    std::vector<std::vector<float>> components;  // [K][rows of the block]
};

// Calls on_block for consecutive blocks of rows, in order, from one thread.
void for_each_encoded_block(const RowSource& rows, const PrincipalComponents& components,
                            uint32_t num_components,
                            const std::function<void(EncodedRows&)>& on_block,
                            uint32_t num_in_flight = kMaxInFlight);

// Memory of for_each_encoded_block() for P columns and K components, in addition to the rows at
// work: the left singular vectors, and either their factors or the blocks that are done.
uint64_t encoded_blocks_bytes(uint64_t num_columns, uint64_t num_components,
                              uint32_t num_in_flight);

}  // namespace paim
