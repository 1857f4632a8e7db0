"""Uses the module as its types promise; mypy --strict reads this file, nobody runs it."""

from pathlib import Path
from typing import Any, Dict

import numpy as np
import numpy.typing as npt
import trunnion

report: Dict[str, Any] = trunnion.check("part.nc", Path("folder"), machine="mill-3axis", options=["--strict"])
rows: npt.NDArray[np.void] = trunnion.trace("part.nc", machine="mill-3axis", dialect="fanuc-30i")
where: str = trunnion.program()
wrong: Exception = trunnion.TrunnionError("text")
