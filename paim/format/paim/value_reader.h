// Reads arrays of a matrix's values: integers of planes, or floats.
#pragma once

#include <span>

#include "paim/codec/stored_values.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/pack/plane_predictor.h"

namespace paim {

// An array of values to read, with the predictor of its integers.
struct ValueJob {
    const Section* section;
    const PlanePredictor* predictor;
    StoredValues* out;
};

// Reads all arrays on all threads; neighbours in the list that have the same type and shape are
// read together. Values are integers as they are stored, or finite floats (checked). The result is
// the same on any number of threads.
// Errors (bad input, unsupported) name the file and the section.
void read_values(const ContainerReader& reader, std::span<const ValueJob> jobs);

StoredValues read_values(const ContainerReader& reader, const Section& section,
                         const PlanePredictor& predictor);

}  // namespace paim
