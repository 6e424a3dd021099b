# Completion of the command allpairs for bash.

_allpairs() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]} words=''
  local scenes='uniform clusters power-law city needles all-overlap mesh' motions='brownian free-fall rotating-gravity'
  COMPREPLY=()
  case $previous in
    --strategy) words='auto exhaustive bvh' ;;
    --format)
      words='table csv json npy'
      [[ $command != elements ]] || words='table json'
      ;;
    --group) words='body file none' ;;
    --up) words='x y z' ;;
    --data | --work)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$current")
      return
      ;;
    --distance | --box | --max-memory | --memory | --port | --pictures | --metres-per-unit | --threads | --boxes | -n | --frames | --seed | --repetitions | --instruction-set) return ;;
  esac
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W 'detect join plan info track elements view report generate bench help --help -h --version -V' -- "$current")
    return
  fi
  if [[ $command == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W 'detect join plan info track elements view report generate bench' -- "$current")
    return
  fi
  if [[ $current == -* ]]; then
    case $command in
      detect)
        words='--distance --box --strategy --threads --verify --exact --clearance --worlds --format -o --output --partial --data --sofa
          --allow-outside --max-memory -h --help'
        ;;
      join) words='--memory --distance --work --threads --resume --count -o --output -h --help' ;;
      plan) words='--memory --distance --work --threads -h --help' ;;
      info) words='--partial --data --sofa --allow-outside --max-memory -h --help' ;;
      view) words='--sequence --distance --box --exact --boxes --clearance --group --up --partial --data --sofa --allow-outside --max-memory -o --output --open --serve --port -h --help' ;;
      report) words='--distance --box --exact --boxes --clearance --group --up --partial --data --sofa --allow-outside --max-memory -o --output --force --pictures --metres-per-unit -h --help' ;;
      track) words='--distance --threads --verify --format --allow-outside --max-memory -o --output -h --help' ;;
      elements) words='--distance --between --threads --format --allow-outside --max-memory -o --output -h --help' ;;
      generate) words='--boxes -n --frames --seed --sorted -o --output -h --help' ;;
      bench)
        words='--boxes -n --seed --sorted --threads --repetitions --unordered --count --strategy --instruction-set --json
          -h --help'
        ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
  [[ $command != generate ]] || scenes+=" $motions"
  if [[ $command == generate || $command == bench ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$scenes" -- "$current")
  fi
}

complete -F _allpairs allpairs
