#include "experiments/stability/precision/precision.h"
#include "experiments/tables/csv.h"

const char* name_of(PrecisionKind kind) {
    constexpr const char* names[] = {"method", "own", "half", "input", "arithmetic", "rays", "march"};
    return names[size_t(kind)];
}

std::string precision_csv(const std::vector<PrecisionRow>& rows) {
    std::string text =
        "case,variant,point,kind,stage,image,format,error,change,share_of_error,value_median,value_p999,differing,"
        "above_half,below_half,wrong,wrong_in_double,non_finite,refusal\n";
    for (const PrecisionRow& r : rows) {
        const auto value = [&](double ValueChange::*part) {
            return r.values ? std::optional((*r.values).*part) : std::nullopt;
        };
        text += csv_line(r.case_name, r.variant, r.point, std::string(name_of(r.kind)), r.stage, r.image, r.format,
                         r.error, r.change, r.share, value(&ValueChange::median), value(&ValueChange::p999),
                         value(&ValueChange::differing), r.above_half, r.below_half, r.wrong, r.wrong_in_double,
                         r.non_finite, r.refusal);
    }
    return text;
}
