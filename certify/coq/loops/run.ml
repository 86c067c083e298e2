(* SPDX-License-Identifier: Apache-2.0 *)
(* Runs the extracted function. Input: lines of words,
     problem N           then N rows of A, b, mu
     policy I K          policy number I of all_policies, at most K drives
   Output: the pivots and states of each drive, and how it ended. Trusted: the conversions below. *)
module B = Z
open Algorithm
let rec nat n = if n = 0 then O else S (nat (n - 1))
let rec int = function O -> 0 | S n -> 1 + int n
let rec pos x = if B.equal x B.one then XH else if B.is_even x then XO (pos (B.shift_right x 1)) else XI (pos (B.shift_right x 1))
let rec of_pos = function XH -> B.one | XO p -> B.shift_left (of_pos p) 1 | XI p -> B.succ (B.shift_left (of_pos p) 1)
let z x = if B.sign x = 0 then Z0 else if B.sign x > 0 then Zpos (pos x) else Zneg (pos (B.neg x))
let of_z = function Z0 -> B.zero | Zpos p -> of_pos p | Zneg p -> B.neg (of_pos p)
let number s : num =
  let n, d = match String.split_on_char '/' s with [n; d] -> n, d | [n] -> n, "1" | _ -> failwith s in
  Obj.magic { qnum = z (B.of_string n); qden = pos (B.of_string d) }
let text (x : num) = let q : q = Obj.magic x in B.to_string (of_z q.qnum) ^ "/" ^ B.to_string (of_pos q.qden)
let rec list = function [] -> Nil | x :: t -> Cons (x, list t)
let rec of_list = function Nil -> [] | Cons (x, t) -> x :: of_list t
let set = function None0 -> "none" | C -> "C" | NC -> "NC" | CF -> "CF" | NCm -> "NC-" | NCp -> "NC+" | Suspended -> "suspended"
let variable r = (if r mod 2 = 0 then "N" else "F") ^ string_of_int (r / 2 + 1)
let policies = Array.of_list (of_list all_policies)
let words () = List.filter ((<>) "") (String.split_on_char ' ' (input_line stdin))
let vector () = list (List.map number (words ()))
let run p i most =
  let pol = policies.(i) in
  Printf.printf "policy %d\n" i;
  let rec go k x =
    if k > most then print_string "end limit\n" else
    match next_with_pivots rationals p pol x with
    | Pair (pivots, r) ->
      List.iter (fun v -> Printf.printf "pivot %d %s %s %s %s %s %s\n" k (variable (int v.driven))
        (match v.driven_to with Establish -> "establish" | To_zero -> "zero") (text v.length_) (variable (int v.limiting))
        (set v.from) (set v.to0)) (of_list pivots);
      match r with
      | End e -> Printf.printf "end %s\n" (match e with Solved -> "solved" | Singular -> "singular" | Ray -> "ray" | Spent -> "spent")
      | Going y ->
        let s = y.point_of in
        Printf.printf "state %s | %s | %s | %s\n" (String.concat " " (List.map set (of_list s.sets)))
          (String.concat " " (List.map text (of_list s.f))) (String.concat " " (List.map text (of_list s.a0)))
          (match y.last with None -> "-" | Some c -> string_of_int (int c));
        go (k + 1) y in
  go 1 (start rationals p)
let () =
  let p = ref None in
  try while true do
    match words () with
    | ["problem"; n] ->
      let n = int_of_string n in
      let a = list (List.init n (fun _ -> vector ())) in let b = vector () in let mu = vector () in
      p := Some { a; b; mu }
    | ["policy"; i; k] -> run (match !p with Some p -> p | None -> failwith "no problem") (int_of_string i) (int_of_string k)
    | _ -> failwith "problem or policy"
  done with End_of_file -> ()
