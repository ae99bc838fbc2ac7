// The search's side of the third codec.
#include "tests/toy_codec/shared_points_encoder.h"

#include <numeric>
#include <utility>

#include "compressor/encode/search/matrix_cost.h"
#include "paim/codec/frame_cost.h"
#include "tests/toy_codec/shared_points.h"

namespace paim::toy {

namespace {

constexpr const char* kSharedPoints = "shared_points";

class Settings : public CodecSettings {
  public:
    CodedTransfer code(const EncodeProblem& problem, const Quantiser& quantiser,
                       Precision /*integers*/) const override {
        std::vector<uint32_t> owners(problem.transfer.num_points);
        std::iota(owners.begin(), owners.end(), 0u);
        std::vector<float> gains(owners.size(), 1.0f);
        return SharedPoints(quantise(problem.transfer, quantiser), std::move(owners),
                            std::move(gains));
    }
    double squared_error(const EncodeProblem& problem, const Quantiser& quantiser) const override {
        return quantised_error(problem.transfer, quantiser);
    }
};

class Encoder : public TransferEncoder {
  public:
    explicit Encoder(const TransferSearchTask& task) : problem_(task.problem) {}

    // All components, with the largest step.
    void add_codings(const CodingRequest& request, std::vector<TransferCoding>& codings) override {
        TransferCoding coding;
        coding.quantiser = {1.0, problem_.transfer.num_components(), problem_.plane_weight};
        coding.quantiser.step =
            largest_step(problem_.transfer, coding.quantiser, request.most_error);
        if (coding.quantiser.step == 0.0) return;
        coding.settings = std::make_shared<Settings>();
        const CodedTransfer transfer =
            coding.settings->code(problem_, coding.quantiser, Precision::i16);
        coding.candidate.codec = SharedPoints::kName;
        coding.candidate.components = transfer->matrix.num_components;
        coding.candidate.numbers = {{kSharedPoints, problem_.transfer.num_points}};
        coding.candidate.bytes = stored_bytes(transfer->matrix, PlanePredictor(), Effort::fast);
        coding.candidate.multiply_adds =
            static_cast<uint32_t>(transfer->cost(problem_.layout, {}, true).per_vertex());
        if (request.decode_cost && coding.candidate.multiply_adds > *request.decode_cost) return;
        codings.push_back(std::move(coding));
    }

  private:
    const EncodeProblem& problem_;
};

}  // namespace

TransferEncoderType encoder_type() {
    EncoderWords words;
    words.description = "points that vertices share";
    words.cost = "K + 2 for each coefficient";
    words.missed = "cannot be met by toys";
    words.numbers = {kSharedPoints};
    words.heading = "shared points";
    return {SharedPoints::kName, false,
            [](const TransferSearchTask& task) -> std::unique_ptr<TransferEncoder> {
                return std::make_unique<Encoder>(task);
            },
            [](const TargetSize& size) {
                CodecMemory memory;
                // The trial coding is no larger than the models that every search makes of so many
                // points. kKeptBytes is made up, so that a test sees it refused.
                memory.num_points = size.streamed.num_vertices;
                memory.num_points_each = 1;
                memory.kept_bytes = kKeptBytes;
                return memory;
            },
            words};
}

}  // namespace paim::toy
