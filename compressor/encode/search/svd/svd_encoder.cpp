// Codec svd in the search.
#include "compressor/encode/search/svd/svd_encoder.h"

#include <utility>

#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/search/part_search.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {

namespace {

uint32_t multiply_adds(const TransferLayout& layout, uint32_t num_components) {
    return static_cast<uint32_t>(svd_cost(layout, num_components, true).per_vertex());
}

class SvdSettings : public CodecSettings {
  public:
    CodedTransfer code(const EncodeProblem& problem, const Quantiser& quantiser,
                       Precision precision) const override {
        return SvdTransfer(
            is_integer(precision)
                ? quantise(problem.transfer, quantiser)
                : float_matrix(problem.transfer, quantiser.num_components, precision));
    }
    double squared_error(const EncodeProblem& problem, const Quantiser& quantiser) const override {
        return quantised_error(problem.transfer, quantiser);
    }
};

class SvdEncoder : public TransferEncoder {
  public:
    explicit SvdEncoder(const TransferSearchTask& task) : task_(task) {}

    void add_codings(const CodingRequest& request, std::vector<TransferCoding>& codings) override {
        const auto add = [&](TransferCoding coding) {
            coding.candidate.codec = SvdTransfer::kName;
            coding.candidate.multiply_adds =
                multiply_adds(task_.problem.layout, coding.candidate.components);
            coding.settings = std::make_shared<SvdSettings>();
            if (request.decode_cost && coding.candidate.multiply_adds > *request.decode_cost) {
                return;
            }
            codings.push_back(std::move(coding));
        };
        if (is_integer(task_.options.precision)) {
            add_integers(request, add);
        } else {
            add(floats(request.most_error));
        }
    }

  private:
    // The fewest components that leave no more than the error.
    TransferCoding floats(double most_error) const {
        const EncodeProblem& problem = task_.problem;
        const uint32_t k =
            fewest_components(tail_errors(problem.transfer, problem.plane_weight), most_error);
        TransferCoding coding;
        coding.precision = task_.options.precision;
        coding.quantiser = {1.0, k, problem.plane_weight};
        const uint64_t value = coding.precision == Precision::f16 ? 2 : 4;
        coding.candidate.components = k;
        coding.candidate.bytes = problem.transfer.mean.size() * (4 + k * value) +
                                 4 * uint64_t{k} * problem.bake.num_poses();
        return coding;
    }

    template <typename Add>
    void add_integers(const CodingRequest& request, const Add& add) const {
        const EncodeProblem& problem = task_.problem;
        const auto is_cheap = [&](uint32_t num_components) {
            return !request.decode_cost ||
                   multiply_adds(problem.layout, num_components) <= *request.decode_cost;
        };
        uint32_t most = problem.transfer.num_components();
        while (most > 0 && !is_cheap(most)) --most;
        if (!is_cheap(most)) return;
        for (PartChoice& choice :
             part_choices(problem.transfer, problem.plane_weight, request.most_error, most,
                          problem.predictor, problem.num_face_vertices, 0, request.preference)) {
            TransferCoding coding;
            coding.quantiser = std::move(choice.quantiser);
            coding.candidate.components = choice.num_components;
            coding.candidate.bytes = choice.bytes;
            add(std::move(coding));
        }
    }

    const TransferSearchTask task_;
};

}  // namespace

TransferEncoderType svd_encoder_type() {
    EncoderWords words;
    words.description = "components over the poses";
    words.cost = "K + 4 for each coefficient, 3 (K + 2) if transfer is coloured";
    words.missed = "needs values of more than 16 bits: use --precision f32";
    return {SvdTransfer::kName, true,
            [](const TransferSearchTask& task) -> std::unique_ptr<TransferEncoder> {
                return std::make_unique<SvdEncoder>(task);
            },
            // Its points are the vertices, and it holds only the factors.
            [](const TargetSize&) { return CodecMemory(); }, words};
}

}  // namespace paim
