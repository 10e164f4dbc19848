#pragma once
#include "variants/passes/declaration.h"

/// Values of all that the conditions of a technique ask for.
class FrameValues {
public:
    explicit FrameValues(KnownValues known) : known_(std::move(known)) {}

    void set(const std::string& name, const nlohmann::json& value);
    void derive(const std::vector<NamedCondition>& conditions) { known_.derive(conditions); }
    const KnownValues& known() const { return known_; }
    /// ", where mode is "hiz"": what was set to another value than it had; "" if nothing was.
    std::string text() const;

private:
    KnownValues known_;
    std::map<std::string, std::string> changed_;
};

/// For each way in which the technique's conditions can hold or not one frame, the defaults first; of more than a
/// thousand a thousand.
std::vector<FrameValues> representative_frames(const Declaration& declaration, const ParameterSet& params);
