#include "experiments/results/tradeoff/answer_context.h"

#include "core/error.h"
#include "core/list_text.h"
#include "experiments/results/files/markdown.h"

namespace {

using Number = std::optional<double>;

/// Of what is known from above alone: by its interval's upper end, where there is one.
std::string bound(const Number& value, const Number& high) {
    return high ? "at most " + shown_number(high) : "about " + shown_number(value);
}

/// Fronts, curves between points, and what lies below them.
struct OfShots : AnswerContext {
    std::string shots() const {
        std::string text;
        if (!machines.empty())
            text =
                "## Each shot\n\nAll points of a technique make the front of the technique. Curves between two points "
                "are interpolated (logarithmic): nothing was run between the points.\n\n";
        for (const auto& shot : between.shots)
            if (!shot->curves.empty())
                text += "### " + markdown_text(shot->label) + "\n\n" + front_sentence(*shot) + "\n\n" +
                        costs_table(*shot) + errors_table(*shot);
        return text;
    }

    std::string front_sentence(const MeasuredShot& shot) const {
        std::vector<const FrontRow*> rows;
        for (const MeasuredPoint& p : shot.points)
            if (p.row.cost) rows.push_back(&p.row);
        std::ranges::stable_sort(rows, {}, [](const FrontRow* row) { return *row->cost; });
        Names sure, maybe;
        size_t beaten = 0;
        for (const FrontRow* row : rows) {
            const std::string label = markdown_text(row->label);
            if (row->verdict == "front")
                sure.push_back(label + " (" + measured(row->cost, row->cost_low, row->cost_high) + " " + unit + ", " +
                               measured(row->error, row->error_low, row->error_high) + ")");
            if (row->verdict == "undecided") maybe.push_back(label);
            beaten += row->verdict == "dominated";
        }
        std::string text = sure.empty() ? "No point is certainly on the front."
                                        : "Certainly on the front: " + joined(sure, ", ") + ".";
        if (!maybe.empty()) text += " Undecided: " + joined(maybe, ", ") + ".";
        if (beaten == 0) return text;
        return message_text(text, " ", counted(beaten, "point"), beaten == 1 ? " is dominated." : " are dominated.");
    }

    /// The curves of more than the baseline alone.
    std::vector<std::pair<std::string, const Curve*>> curves_of(const MeasuredShot& shot) const {
        std::vector<std::pair<std::string, const Curve*>> curves;
        for (const auto& [technique, curve] : shot.curves)
            if (curve.points().size() > 1 || curve.points().front()->name() != found.baseline)
                curves.emplace_back(technique, &curve);
        return curves;
    }

    std::string costs_table(const MeasuredShot& shot) const {
        Names head = {"technique", "measured at (" + unit + ")"};
        for (const double cost : costs) head.push_back("error at " + shown_number(cost) + " " + unit);
        std::vector<Names> cells;
        for (const auto& [technique, curve] : curves_of(shot)) {
            Names& line = cells.emplace_back(
                Names{technique, shown_number(curve->start()) + " to " + shown_number(curve->end())});
            for (const ErrorAtCostRow& row : between.error_at_cost)
                if (row.shot == shot.name && row.technique == technique) line.push_back(error_text(row));
        }
        return markdown_table(head, cells);
    }

    static std::string error_text(const ErrorAtCostRow& row) {
        if (!row.error && row.point.empty())
            return "no point below " + shown_number(row.start) + (row.fits == "maybe" ? " (may fit)" : "");
        const std::string text = row.status == "past end"
                                     ? bound(row.error, row.high) + ", reached at " + shown_number(row.end)
                                     : measured(row.error, row.low, row.high);
        return text + (row.fits == "surely" ? "" : " (may not fit)");
    }

    std::string errors_table(const MeasuredShot& shot) const {
        if (!shot.divisor) return "";
        Names head = {"technique"};
        for (const double factor : factors)
            head.push_back(unit + " for " + shown_number(factor) + " times the error of " + base + " (" +
                           shown_number(factor * *shot.divisor) + ")");
        std::vector<Names> cells;
        for (const auto& [technique, curve] : curves_of(shot)) {
            Names& line = cells.emplace_back(Names{technique});
            for (const CostToErrorRow& row : between.cost_to_error)
                if (row.shot == shot.name && row.technique == technique) line.push_back(cost_text(row));
        }
        return markdown_table(head, cells);
    }

    static std::string cost_text(const CostToErrorRow& row) {
        if (row.status == "not reached")
            return std::string(*row.share_that_reach < 0.025 ? "not" : "perhaps not") + " reached up to " +
                   shown_number(row.end);
        if (row.status == "before start") return bound(row.cost, row.high) + ", the cheapest point";
        return row.low ? measured(row.cost, row.low, row.high) : bound(row.cost, row.high);
    }

    std::string floors() const {
        if (between.fits.empty() && between.limits.empty()) return "";
        return "## What more " + (is_timed() ? "time" : unit) + " cannot improve\n\n" + limits() + fits();
    }

    std::string limits() const {
        const std::string rung = rungs.front();
        std::vector<Names> cells;
        size_t clear = 0, above = 0;
        for (const LimitRow& row : between.limits) {
            if (row.rung != rung) continue;
            clear += row.over_rung_high.has_value();
            above += row.over_rung_high && *row.over_rung_low > 1;
            cells.push_back({shot_of(row.shot).label, row.label, shown_number(row.cost),
                             measured(row.error, row.error_low, row.error_high),
                             measured(row.rung_error, row.rung_low, row.rung_high),
                             measured(row.over_rung, row.over_rung_low, row.over_rung_high)});
        }
        if (cells.empty()) return "";
        std::string text =
            "`" + rung +
            "` is the lower bound for any single-frame technique. Such a technique finds all that the image shows, and "
            "uses the environment elsewhere. Only knowledge of earlier frames, or luck, can go below this bound. ";
        if (clear > 0)
            text += message_text("The bound is significantly above 0 in ", counted(clear, "shot"), ". In ", above,
                                 " of these the least error of all points is significantly above the "
                                 "bound: better techniques are possible there.");
        return text + "\n\n" +
               markdown_table({"shot", "least error", unit, "its error", "`" + rung + "`", "error / `" + rung + "`"},
                              cells);
    }

    std::string fits() const {
        if (between.fits.empty()) return "";
        const auto axis_of = [](const FitRow& row) {
            return row.technique + (row.fixed.empty() ? "" : " " + row.fixed) + " along " + row.parameter;
        };
        std::string text =
            "The law error = floor + a cost^-b is fitted along each axis of quality. The floor is a lower bound at any "
            "cost, along this axis alone.\n\n";
        std::vector<Names> cells;
        for (const std::string& axis : distinct(between.fits, axis_of)) {
            size_t of_axis = 0, floors = 0, above = 0;
            std::string rung;  // that of the first floor above it
            for (const FitRow& row : between.fits) {
                if (axis_of(row) != axis) continue;
                const bool has_floor = row.floor_low.value_or(0) > 0;
                const bool is_above = has_floor && row.floor_over_rung_low.value_or(0) > 1;
                if (is_above && above == 0) rung = row.rung;
                ++of_axis, floors += has_floor, above += is_above;
                cells.push_back({axis, shot_of(row.shot).label, std::to_string(row.points),
                                 shown_number(row.cost_from) + " to " + shown_number(row.cost_to),
                                 measured(row.floor, row.floor_low, row.floor_high),
                                 measured(row.floor_over_rung, row.floor_over_rung_low, row.floor_over_rung_high),
                                 measured(row.b, row.b_low, row.b_high), shown_number(row.misfit), row.status});
            }
            text += message_text("- ", markdown_text(axis), ": the floor is significantly above 0 in ", floors, " of ",
                                 counted(of_axis, "shot"));
            if (above > 0) text += message_text(", and significantly above ", markdown_code(rung), " in ", above);
            text += ".\n";
        }
        return text + "\n" +
               markdown_table({"axis", "shot", "points", unit, "floor", "floor / rung", "b", "misfit", "status"},
                              cells);
    }
};

}  // namespace

std::string answers_of_shots(const AnswerContext& context) {
    const OfShots answers{context};
    return answers.shots() + answers.floors();
}
