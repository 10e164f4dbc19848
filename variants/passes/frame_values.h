#pragma once
#include "variants/passes/declaration.h"

/// The values that a technique's conditions use, for one frame.
class FrameValues {
public:
    explicit FrameValues(KnownValues known) : known_(std::move(known)) {}

    void set(const std::string& name, const nlohmann::json& value);
    void derive(const std::vector<NamedCondition>& conditions) { known_.derive(conditions); }
    const KnownValues& known() const { return known_; }
    /// The values that set() changed, as ", where mode is 'hiz'"; "" if there are none.
    std::string text() const;

private:
    KnownValues known_;
    std::map<std::string, std::string> changed_;
};

/// One frame for each combination in which the technique's conditions can hold, the defaults first; of more than 1000
/// only 1000.
std::vector<FrameValues> representative_frames(const Declaration& declaration, const ParameterSet& params);
