"""Numbers and their intervals as text."""

import math


def decimals(value, low=None, high=None):
    """Decimals that show two digits of the interval's half-width, else three of the value; never more than four digits of the value."""
    size = abs(value)
    if size == 0 or not math.isfinite(size):
        return 2
    most = 3 - math.floor(math.log10(size))
    half = max(high - low, 0) / 2 if low is not None and high is not None else None  # means of equal values round either way
    wanted = most - 1 if not half else 1 - math.floor(math.log10(half))
    return max(min(wanted, most), 0)


def short(value, groups_thousands=False):
    """A number of a tick or sentence: three digits, as 0.125, 1.5e-4 and 2e5; if asked, from 1000 on as 200 000."""
    if groups_thousands and value >= 1000:
        return f"{value:,.0f}".replace(",", "\N{THIN SPACE}")
    if 0 < abs(value) < 1e-3:
        mantissa, exponent = f"{value:.2e}".split("e")
        return f"{float(mantissa):g}e{int(exponent)}"
    return f"{value:.3g}".replace("e+0", "e")


def text(value, places):
    if value != 0 and abs(value) < 1e-4:
        return f"{value:.1e}"
    return f"{value:.{places}f}"


def with_interval(measured, between=" "):
    """0.710 [0.703, 0.717] from value, low and high; the value alone if there is no interval."""
    places = decimals(measured.value, measured.low, measured.high)
    if measured.low is None or measured.high is None:
        return text(measured.value, places)
    return f"{text(measured.value, places)}{between}[{text(measured.low, places)}, {text(measured.high, places)}]"


def in_prose(value, low=None, high=None):
    """0.17 [0.12, 0.24]: two digits of the value, and more where the interval is narrower than the second."""
    second_digit = lambda v: 1 - math.floor(math.log10(abs(v))) if v else 0  # noqa: E731
    places = second_digit(value)
    if low is not None and high > low:
        places = max(places, second_digit((high - low) / 2) - 1)
    said = lambda v: f"{round(v, places):.{max(places, 0)}f}"  # noqa: E731
    return said(value) if low is None else f"{said(value)} [{said(low)}, {said(high)}]"


def count(value, keeps_zeros=True):
    """A count, or a mean of counts, with three digits: 12.3 M for 12 345 678. Without zeros at the end below 1000, and above if asked. A
    no-break space joins number and letter."""
    rounded = f"{value:.2e}"
    exponent = int(rounded.split("e")[1])
    thousands = max(min(exponent // 3, 3), 0)
    shown = float(rounded) / 1000**thousands
    text = f"{shown:.{max(2 - exponent + 3 * thousands, 0)}f}" if keeps_zeros and thousands else f"{shown:g}"
    return text + ("", "\N{NO-BREAK SPACE}k", "\N{NO-BREAK SPACE}M", "\N{NO-BREAK SPACE}G")[thousands]
