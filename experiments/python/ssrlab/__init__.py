"""Results of ssrlab for notebooks and scripts. No verdict is computed here: what is best, significant or on the front are columns.

    import ssrlab
    results = ssrlab.read("results/quickstart")
    results["summary"]                    # a pandas.DataFrame of summary.csv; so of every table of the folder
    results.units("time_summary")         # column to unit; results.meanings(...) says what each is
    results.primary_errors()              # the rows that the study is made to compare, which stand for their shot

Put experiments/python on the path. Only read() needs Debian's python3-pandas.
"""


def read(folder):
    """The tables of a results folder, see dataframes.read()."""
    from ssrlab import dataframes  # here, so that figures need no pandas

    return dataframes.read(folder)


__all__ = ["read"]
