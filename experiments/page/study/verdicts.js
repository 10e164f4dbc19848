// What became of rays, by name, colour and words.

export const errorStage = "error";  // rows of that stage share out the squared error, not the rays

// Okabe and Ito's colours, as in the maps of the verdicts; `short` is written into bars that have room.
export const verdicts = [
    {key: "right", name: "right", color: "#009e73", short: "right"},
    {key: "unavoidable_miss", name: "rightly missed: not on the screen", color: "#0072b2", short: "off screen"},
    {key: "empty", name: "rightly missed: nothing there", color: "#808080", short: "nothing"},
    {key: "avoidable_miss", name: "missed", color: "#f0e442", short: "missed"},
    {key: "wrong_place", name: "wrong place", color: "#e69f00", short: "wrong place"},
    {key: "false_hit", name: "false hit", color: "#cc79a7", short: "false hit"}
];

/// What a ray did that missed what the screen shows, by the outcome that its tracer gave (variants/tracers/outcome.h).
export const missTexts = {
    off_screen: "left the screen",
    behind_camera: "reached the camera",
    unfinished: "ran out of steps",
    background: "ended on the background",
    too_thick: "went too far behind a surface",
    from_behind: "met the back of a surface",
    own_surface: "met what they started from",
    hidden: "met what is hidden",
    hit: "hit with too little confidence"
};

const untraced = {
    key: "untraced",
    name: "no ray was traced",
    color: "#d5c7a3",
    short: "untraced"
};

export const sharedOut = [...verdicts, untraced];

/// Where a verdict puts an error, after "lies".
export const causeTexts = {
    avoidable_miss: "where rays missed what the screen shows",
    wrong_place: "where rays hit the wrong place",
    false_hit: "where rays hit what is not there",
    unavoidable_miss: "where the truth is not on the screen",
    empty: "where nothing is there to be hit",
    right: "where rays were right (filter, fallback, view dependence)",
    untraced: "where no ray was traced"
};
