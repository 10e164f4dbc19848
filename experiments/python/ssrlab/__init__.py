"""Results of ssrlab for notebooks and scripts. Nothing is judged here: verdicts, ranks and fronts are columns of the tables.

    import ssrlab
    results = ssrlab.read("results/quickstart")
    results["summary"]                    # a pandas.DataFrame of summary.csv; so of every table of the folder
    results.units("time_summary")         # column to unit; results.meanings(...) says what each is
    results.primary_errors()              # rows of the study's main error that represent their shot

Put experiments/python on the path. Only read() needs Debian's python3-pandas.
"""


def read(folder):
    """The tables of a results folder, see dataframes.read()."""
    from ssrlab import dataframes  # here, so that figures need no pandas

    return dataframes.read(folder)


__all__ = ["read"]
